#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <variant>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/staged_buffer.h"
#include "framegraph/vulkan/staged_image.h"
#include "samples/denoise/gpu_device.h"
#include "samples/denoise/uploaded_texture.h"

namespace walr {

/// A frame graph on a device: its plan, and the executor that runs it.
class DeviceGraph {
 public:
  /// Measures the times of passes if the device has timestamps. Takes pipelines from the device.
  /// @param gpu          must outlive this
  /// @param predecessor  graph whose histories and pipelines are taken over where they fit; may be null. See
  ///                     `fg::vk::ExecutorOptions::predecessor`, also for how long it must live
  /// @param shared       what this graph shares with others on the device, see `fg::vk::ExecutorOptions::shared`
  /// @throws see `compileFor` and `fg::vk::Executor`
  DeviceGraph(const GpuDevice& gpu, const fg::Graph& graph, std::uint32_t framesInFlight,
              DeviceGraph* predecessor = nullptr, const fg::vk::Membership& shared = {});

  [[nodiscard]] const fg::Plan& plan() const { return plan_; }
  [[nodiscard]] fg::vk::Executor& executor() { return executor_; }

 private:
  fg::Plan plan_;
  fg::vk::Executor executor_;
};

/// A graph that runs without a window, with several frames in flight, and reads back some textures and buffers.
class ReadbackGraph {
 public:
  /// Identifies a texture or buffer that is read back.
  using Index = std::size_t;

  /// @param gpu, graph  must outlive this
  /// @param shared      see `DeviceGraph`
  ReadbackGraph(const GpuDevice& gpu, const fg::Graph& graph, std::uint32_t framesInFlight,
                const fg::vk::Membership& shared = {});

  /// Make an image for a texture that the graph imports as `fg::vk::kUploaded`. It lives as long as this.
  UploadedTexture& addUpload(fg::Texture texture);
  /// Read back a texture that the graph imports as `fg::vk::kOverwritable` and exports as `fg::vk::kReadable`.
  Index readBack(fg::Texture texture);
  /// The same for a buffer.
  Index readBack(fg::Buffer buffer);

  [[nodiscard]] fg::vk::Executor& executor() { return graph_.executor(); }
  [[nodiscard]] const fg::Plan& plan() const { return graph_.plan(); }
  /// Start a frame. @throws std::logic_error if `framesInFlight` frames are in flight already
  fg::vk::Frame begin();
  /// Record the graph and the copies for reading back, and submit the frame to the device.
  void submit(const fg::vk::Frame& frame);
  [[nodiscard]] bool full() const { return inFlight_.size() == framesInFlight_; }
  [[nodiscard]] bool empty() const { return inFlight_.empty(); }
  /// Wait for the oldest frame in flight; there must be one.
  /// @returns its slot. The slot's data stay valid until `framesInFlight` further frames have begun
  std::uint32_t finish();
  /// Contents after a finished frame: rows of texels without padding, or the bytes of a buffer.
  template <typename T>
  [[nodiscard]] std::vector<T> read(Index index, std::uint32_t slot) const;

 private:
  using Readback = std::variant<fg::vk::StagedImage, fg::vk::StagedBuffer>;
  [[nodiscard]] std::span<const std::byte> staging(Index index, std::uint32_t slot) const;

  const GpuDevice& gpu_;
  const fg::Graph& declared_;
  std::uint32_t framesInFlight_;
  DeviceGraph graph_;
  std::deque<UploadedTexture> uploads_;
  std::vector<Readback> readbacks_;
  fg::vk::FrameQueue queue_;            // Its destructor waits for frames that use what is above.
  std::deque<std::uint32_t> inFlight_;  // Slots, the oldest first.
};

template <typename T>
std::vector<T> ReadbackGraph::read(Index index, std::uint32_t slot) const {
  const std::span<const std::byte> bytes = staging(index, slot);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::ranges::copy(bytes, std::as_writable_bytes(std::span(values)).begin());
  return values;
}

}  // namespace walr
