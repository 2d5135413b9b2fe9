#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "samples/denoise/device_graph.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/host_frame.h"
#include "samples/host/host_graph.h"
#include "samples/host/shaders/view_constants.h"

namespace walr::host {

/// What comes back of a frame.
struct RenderedFrame {
  int number = 0;
  std::vector<std::uint32_t> display;  ///< RGBA8, red in the lowest byte, rows from the top.
  Image composite;                     ///< 3 components; empty unless asked for.
  Image denoised;                      ///< 3 components; empty unless asked for.
  std::vector<fg::vk::PassTime> passTimes;
};

/// Runs the host's frame on a device without a window: one graph, compiled once, executed every frame, with a few
/// frames on the device at once.
class Renderer {
 public:
  struct Options {
    HostView view = {};
    ViewConstants viewConstants = {};
    std::uint32_t framesInFlight = 2;  ///< At least 1.
    bool readComposite = false;
    bool readDenoised = false;
  };

  /// @param gpu     must outlive the renderer
  /// @param method  declares its passes here; not needed afterwards
  /// @throws see `declareHostGraph` and `compileFor`
  Renderer(const GpuDevice& gpu, Denoiser& method, fg::Extent extent, const Options& options);

  /// Send a frame to the device. Its history is dropped first where the frame says so.
  /// @throws std::logic_error when as many frames as may be are in flight
  void submit(const HostFrame& frame);
  [[nodiscard]] bool full() const { return graph_.full(); }
  /// Wait for the oldest frame in flight. Nothing where there is none.
  std::optional<RenderedFrame> finish();

  [[nodiscard]] const fg::Graph& graph() const { return host_.graph; }
  [[nodiscard]] const fg::Plan& plan() const { return graph_.plan(); }

 private:
  fg::Extent extent_;
  Options options_;
  HostGraph host_;
  ReadbackGraph graph_;
  ReadbackGraph::Index display_;
  std::optional<ReadbackGraph::Index> composite_;
  std::optional<ReadbackGraph::Index> denoised_;
  std::deque<int> numbers_;  // Of the frames in flight.
};

/// Hand a frame's pictures and constants to an executor of the graph, for the frame recorded next.
void uploadFrame(fg::vk::Executor& executor, const HostGraph& graph, const HostFrame& frame, const ViewConstants& view);

}  // namespace walr::host
