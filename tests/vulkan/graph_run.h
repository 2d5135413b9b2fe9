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

/// Where to run: a whole device, or a context whose functions a test has tampered with.
struct GpuQueue {
  GpuQueue(const vk::Device& device) : context(device.context()), queue(device.queue()) {}
  GpuQueue(const vk::DeviceContext& tampered, VkQueue queueOfDevice) : context(tampered), queue(queueOfDevice) {}
  const vk::DeviceContext& context;
  VkQueue queue;
};

/// Compile for a device.
/// @throws std::runtime_error with the diagnostics where the graph has errors
Plan compileFor(const vk::DeviceContext& device, const Graph& graph, bool poison = false);

/// A graph on a device, frame by frame, with two frames in flight. Imported textures get an image each: those that
/// arrive as `vk::kUploaded` are filled by the test, those that arrive as `vk::kOverwritable` are read back, as are
/// imported buffers that do. What arrives otherwise the test binds itself.
class GraphRun {
 public:
  GraphRun(const GpuQueue& gpu, const Graph& graph, const vk::ExecutorOptions& options = {});
  /// With a plan that the test made or changed.
  GraphRun(const GpuQueue& gpu, const Graph& graph, Plan plan, const vk::ExecutorOptions& options = {});

  [[nodiscard]] vk::Executor& executor() { return executor_; }

  /// The image that the run made for an output.
  [[nodiscard]] vk::ExternalImage external(Texture output) const { return readbacks_.at(output.resource)->external(); }

  /// Texels that the next frame uploads, and those after it until told otherwise.
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

  /// Texels of an output as the frame last submitted with the slot left them. That frame must be finished.
  template <typename T>
  [[nodiscard]] std::vector<T> texels(Texture texture, std::uint32_t slot) const {
    const auto bytes = readbacks_.at(texture.resource)->staging(slot);
    std::vector<T> result(bytes.size() / sizeof(T));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
    return result;
  }
  /// Of the frame last submitted, once `frame` or `finish` has returned.
  template <typename T>
  [[nodiscard]] std::vector<T> texels(Texture texture) const {
    return texels<T>(texture, lastSlot_);
  }

  /// Contents of a buffer as the frame last submitted with the slot left them. That frame must be finished.
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
