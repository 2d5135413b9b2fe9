#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "samples/denoise/device_graph.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/host_frame.h"
#include "samples/host/host_graph.h"
#include "samples/host/shaders/view_constants.h"

namespace walr::host {

/// The images of a frame that are read back.
struct RenderedFrame {
  int number = 0;
  std::vector<std::uint32_t> display;  ///< RGBA8, red in the lowest byte, rows from the top.
  Image composite;                     ///< 3 components; empty unless requested.
  Image denoised;                      ///< 3 components; empty unless requested.
  std::vector<fg::vk::PassTime> passTimes;
  TracedRays traced;
};

/// Runs the host's frame on a device without a window: one graph, compiled once and executed every frame, with a few
/// frames in flight.
class Renderer {
 public:
  struct Options {
    HostView view = {};
    LightPattern light = {};  ///< Of the frames.
    ViewConstants viewConstants = {};
    std::uint32_t framesInFlight = 2;  ///< At least 1.
    bool readComposite = false;
    bool readDenoised = false;
    const gpu_render::GpuScene* scene = nullptr;  ///< See `declareHostGraph`; must outlive the renderer.
    bool specular = false;                        ///< See `declareHostGraph`.
  };

  /// @param gpu     must outlive the renderer
  /// @param method  declares its passes during this call; not needed afterwards
  /// @throws see `declareHostGraph` and `compileFor`
  Renderer(const GpuDevice& gpu, Denoiser& method, fg::Extent extent, const Options& options);

  /// Submit a frame to the device. If the frame requests it, histories are reset first.
  /// @throws std::logic_error if `framesInFlight` frames are in flight already
  void submit(const HostFrame& frame);
  [[nodiscard]] bool full() const { return graph_.full(); }
  /// Wait for the oldest frame in flight. Returns nullopt if there is none.
  std::optional<RenderedFrame> finish();

  [[nodiscard]] fg::vk::Executor& executor() { return graph_.executor(); }
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
  std::optional<ReadbackGraph::Index> rays_;
  struct Submitted {
    int number;
    TracedRays traced;
  };
  std::deque<Submitted> submitted_;  // The frames in flight, the oldest first.
};

/// The rays that the device traced in a frame.
/// @param rows  contents of `HostGraph::rays`
TracedRays tracedByDevice(std::span<const std::uint32_t> rows, std::span<const fg::vk::PassTime> passTimes);

/// Upload a frame's images and constants to an executor of the graph, for the frame that is recorded next.
void uploadFrame(fg::vk::Executor& executor, const HostGraph& graph, const HostFrame& frame, const ViewConstants& view);

}  // namespace walr::host
