#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/device.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/staged_buffer.h"
#include "framegraph/vulkan/staged_image.h"

namespace fg::test {

inline constexpr std::uint32_t kFramesInFlight = 2;

/// The queue to run on, with a device or with a context in which a test has replaced functions (function_hooks.h).
struct GpuQueue {
  GpuQueue(const vk::Device& device) : context(device.context()), queue(device.queue()) {}
  GpuQueue(const vk::DeviceContext& tampered, VkQueue queueOfDevice) : context(tampered), queue(queueOfDevice) {}
  const vk::DeviceContext& context;
  VkQueue queue;
};

/// Compile for a device.
/// @throws std::runtime_error with the diagnostics if the graph has errors
Plan compileFor(const vk::DeviceContext& device, const Graph& graph, bool poison = false);

/// Runs a graph on a device frame by frame, with two frames in flight. It creates an image for every texture that is
/// imported as `vk::kUploaded`, which the test fills, and an image or buffer for every resource imported as
/// `vk::kOverwritable`, which is read back. The test must bind imports in other states itself.
class GraphRun {
 public:
  GraphRun(const GpuQueue& gpu, const Graph& graph, const vk::ExecutorOptions& options = {});
  /// Runs a plan that the test has made or changed.
  GraphRun(const GpuQueue& gpu, const Graph& graph, Plan plan, const vk::ExecutorOptions& options = {});

  [[nodiscard]] vk::Executor& executor() { return executor_; }

  /// The image that the run has created for an output.
  [[nodiscard]] vk::ExternalImage external(Texture output) const { return readbacks_.at(output.resource)->external(); }

  /// Set the texels that the following frames upload.
  template <typename T>
  void fill(Texture texture, const std::vector<T>& texels) {
    auto& bytes = uploads_.at(texture.resource).bytes;
    bytes.resize(texels.size() * sizeof(T));
    std::memcpy(bytes.data(), texels.data(), bytes.size());
  }
  /// Record and submit one frame, waiting only for the frame that used its slot before. Returns the slot.
  std::uint32_t submitFrame();
  /// Wait for all frames.
  void finish() { queue_.waitAll(); }
  /// `submitFrame` and wait for it.
  void frame();

  /// Texels of an output after the frame last submitted with the slot, which must have finished.
  template <typename T>
  [[nodiscard]] std::vector<T> texels(Texture texture, std::uint32_t slot) const {
    const auto bytes = readbacks_.at(texture.resource)->staging(slot);
    std::vector<T> result(bytes.size() / sizeof(T));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
    return result;
  }
  /// The same for the frame last submitted. Call `frame` or `finish` first.
  template <typename T>
  [[nodiscard]] std::vector<T> texels(Texture texture) const {
    return texels<T>(texture, lastSlot_);
  }

  /// Contents of a buffer after the frame last submitted with the slot, which must have finished.
  template <typename T>
  [[nodiscard]] std::vector<T> elements(Buffer buffer, std::uint32_t slot) const {
    const auto bytes = bufferReadbacks_.at(buffer.resource)->staging(slot);
    std::vector<T> result(bytes.size() / sizeof(T));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
    return result;
  }

 private:
  struct Upload {
    std::unique_ptr<vk::StagedImage> image;
    std::vector<std::byte> bytes;
  };
  vk::Executor executor_;
  std::map<std::uint32_t, Upload> uploads_;
  std::map<std::uint32_t, std::unique_ptr<vk::StagedImage>> readbacks_;
  std::map<std::uint32_t, std::unique_ptr<vk::StagedBuffer>> bufferReadbacks_;
  vk::FrameQueue queue_;
  std::uint32_t lastSlot_ = 0;
};

}  // namespace fg::test
