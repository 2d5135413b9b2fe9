#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/history_state.h"
#include "framegraph/vulkan/pipelines.h"
#include "framegraph/vulkan/timestamps.h"

namespace fg::vk {

class Executor;

struct ExecutorOptions {
  std::uint32_t framesInFlight = 2;  ///< Frames that may be on the GPU at once; at least 1.
  bool timestamps = false;           ///< Measure GPU time of every pass.
  /// Fill every transient resource with NaN where it takes over its memory, so that whoever reads what was never
  /// written shows it (see FillPattern::Poison). Compile the plan with a DriverMemoryModel made for poison.
  bool poison = false;
  /// Where pipelines are looked up and kept, such as `PipelineCache::handle`; optional. Must outlive the executor and
  /// those that name it as their predecessor.
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  /// An executor of the same device to take over from, of any graph. Its pipelines are shared, so that only those of
  /// new shaders and specialization constants are made, and `pipelineCache` is its own. The first frame goes on from
  /// the histories that its last frame left: see `inheritHistories`. It may not record any more, and must live until
  /// the GPU has finished the first frame of the new one.
  const Executor* predecessor = nullptr;
  /// Whether histories of the predecessor go on with their ages, where name, format, mip levels and layers are the
  /// same; all others start anew. Sizes may differ: the first frame reads a history in the size that it has. Without
  /// this, only pipelines are shared, and the predecessor need not live on.
  bool inheritHistories = true;
};

/// An image that the host binds to an imported texture.
struct ExternalImage {
  VkImage image = VK_NULL_HANDLE;
  /// Any number that tells this image from all others of the host, ever: handles are recycled, so that a handle seen
  /// before may be another image. Views are kept by it. 0 stands for the handle, for hosts that never destroy one
  /// without `Executor::forget`.
  std::uint64_t identity = 0;
};

/// Makes everything that a plan needs, once, and records frames. Where the instance has VK_EXT_debug_utils, objects
/// carry the names that were declared and every pass is a labelled region.
///
/// Recording allocates nothing on the heap and makes no Vulkan object, except the views of an imported image that is
/// seen for the first time.
///
/// Recorded frames must be submitted in the order of recording, all to one queue. Not for use from several threads at
/// once.
class Executor {
 public:
  /// @param device must outlive the executor
  /// @param graph, plan the declared graph and what `compile` made of it for this device; copied
  /// @throws OutOfMemory, PipelineFailed, Unsupported or Error; everything made until then is released
  Executor(const DeviceContext& device, GraphDesc graph, Plan plan, const ExecutorOptions& options = {});
  /// The GPU must have finished all recorded frames.
  ~Executor();
  Executor(Executor&&) noexcept;
  Executor& operator=(Executor&&) noexcept;

  /// Set the bytes of an upload buffer for the frames recorded from now on.
  /// @throws std::invalid_argument naming the buffer where the size is not the declared one
  void upload(Buffer buffer, std::span<const std::byte> bytes);
  template <typename T>
  void upload(Buffer buffer, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    upload(buffer, std::as_bytes(std::span(&value, 1)));
  }

  /// Bind the host's image or buffer to an import, for the frames recorded from now on. It must be as declared, with
  /// the usage flags of `usage`, and in the declared state when the frame starts.
  /// @throws std::invalid_argument where the handle was not declared with Graph::import
  void bind(Texture texture, const ExternalImage& image);
  void bind(Buffer buffer, VkBuffer handle);
  /// Destroy the views of a host image. Call before the image is destroyed and after the GPU has finished with it.
  void forget(const ExternalImage& image);
  /// Usage flags that an imported image or buffer must have been created with.
  [[nodiscard]] VkImageUsageFlags usage(Texture texture) const;
  [[nodiscard]] VkBufferUsageFlags usage(Buffer buffer) const;

  /// Take over what a graph of the same topology (see `sameTopology`) says of push constants, specialization constants,
  /// work group counts and callbacks, for the frames recorded from now on. Memory, histories and their ages stay as
  /// they are; a pipeline is made where specialization constants have values not seen before.
  /// @throws std::invalid_argument where the topology is another: compile the graph and make an executor for it;
  ///         PipelineFailed, OutOfMemory or Unsupported, and the executor goes on as it was
  void update(const GraphDesc& graph);

  /// Record one frame.
  /// @param commandBuffer in the recording state, outside of a render pass
  /// @param slot 0 to framesInFlight - 1; the GPU must have finished the frame last recorded with it
  /// @throws Error naming an import that nothing is bound to, or std::out_of_range for the slot
  void record(VkCommandBuffer commandBuffer, std::uint32_t slot);

  /// Drop what a history holds: the next frame finds zeros and age 0 (camera cut, frames skipped).
  void resetHistory(const History& history);
  void resetAllHistory();
  /// What the next frame will find.
  [[nodiscard]] HistoryStatus historyStatus(const History& history) const;

  /// Image or buffer behind a handle in the frame recorded last, for exported resources that the host did not import.
  [[nodiscard]] VkImage image(Texture texture) const;
  [[nodiscard]] VkBuffer buffer(Buffer buffer) const;

  /// GPU times of the frame last recorded with a slot, which the GPU must have finished. Valid until the next call;
  /// empty without `ExecutorOptions::timestamps`.
  [[nodiscard]] std::span<const PassTime> passTimes(std::uint32_t slot);
  /// Device memory allocated, in bytes.
  [[nodiscard]] std::uint64_t allocatedBytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fg::vk
