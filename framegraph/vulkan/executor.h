#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/history_state.h"
#include "framegraph/vulkan/shared_objects.h"
#include "framegraph/vulkan/timeline_point.h"
#include "framegraph/vulkan/timestamps.h"

namespace fg::vk {

class Executor;

struct ExecutorOptions {
  std::uint32_t framesInFlight = 2;  ///< Frames that may be on the GPU at the same time; at least 1.
  bool timestamps = false;           ///< Measure GPU time of every pass.
  /// For debugging: fill every transient with NaN when it takes over its memory, so that a read of texels that were
  /// never written shows up (see FillPattern::Poison). Compile the plan with a DriverMemoryModel for poison.
  bool poison = false;
  /// Used to create pipelines, for instance `PipelineCache::handle`; optional. Must outlive the executor and those that
  /// name it as their predecessor.
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  /// Pipelines that executors of the device share otherwise than as members or successors, and to which this one adds;
  /// optional. `pipelineCache` then does not count.
  std::shared_ptr<Pipelines> pipelines = nullptr;
  /// What this executor shares with others whose frames come before and after its own on one queue; optional. Its
  /// pipelines count, and neither `pipelines` nor `pipelineCache`.
  Membership shared = {};
  /// An executor of the same device that this one replaces, of any graph. Pipelines are shared, so only those for
  /// new shaders and specialization constants are created, in the predecessor's `pipelineCache`. The first frame of
  /// this executor may read the histories of the predecessor: see `inheritHistories`. The predecessor must not record
  /// any more, and must live until the GPU has finished that first frame.
  const Executor* predecessor = nullptr;
  /// Whether to inherit those histories of the predecessor, with their ages, that have the same name, format, mip
  /// levels and layers; all others restart. Sizes may differ: the first frame reads a history at its old size.
  /// Otherwise only pipelines are shared, and the predecessor may be destroyed once the GPU has finished its frames.
  bool inheritHistories = true;
};

/// An image that the host binds to an imported texture.
struct ExternalImage {
  VkImage image = VK_NULL_HANDLE;
  /// The key of the image's views: a number that no other image of the host has or will ever have. It is needed because
  /// Vulkan reuses handles. 0 means the handle; such a host must call `Executor::forget` before it destroys an image.
  std::uint64_t identity = 0;
};

/// Creates everything that a plan needs once, and records frames. If the instance has VK_EXT_debug_utils, objects have
/// their declared names and every pass is a labelled region.
///
/// Recording allocates nothing on the heap and creates no Vulkan object, except views of an imported image that is
/// bound for the first time.
///
/// Recorded frames must be submitted in the order of recording, all to one queue. Not thread-safe. Functions that take
/// a resource or a history throw std::invalid_argument if the graph has none of this index, and those that take a slot
/// std::out_of_range.
class Executor {
 public:
  /// @param device must outlive the executor
  /// @param graph, plan the declared graph and its plan from `compile` for this device; copied
  /// @throws OutOfMemory, PipelineFailed, Unsupported or Error; everything created until then is released
  Executor(const DeviceContext& device, GraphDesc graph, Plan plan, const ExecutorOptions& options = {});
  /// The GPU must have finished all recorded frames.
  ~Executor();
  Executor(Executor&& other) noexcept;
  Executor& operator=(Executor&& other) noexcept;

  /// Set the bytes of an upload buffer for the frames recorded from now on.
  /// @throws std::invalid_argument naming the buffer if the size is not the declared one
  void upload(Buffer buffer, std::span<const std::byte> bytes);
  template <typename T>
  requires(!std::convertible_to<const T&, std::span<const std::byte>>) void upload(Buffer buffer, const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    upload(buffer, std::as_bytes(std::span(&value, 1)));
  }

  /// Bind the host's image or buffer to an import, for the frames recorded from now on. It must be as declared, with
  /// the usage flags of `usage`, and in the declared state when the frame starts.
  /// @throws std::invalid_argument if the handle was not declared with Graph::import; OutOfMemory if a view cannot be
  ///         created, and what was bound before stays bound
  void bind(Texture texture, const ExternalImage& image);
  void bind(Buffer buffer, VkBuffer handle);
  /// Destroy the views of a host image. Call it before the image is destroyed and after the GPU has finished with it.
  void forget(const ExternalImage& image);
  /// Usage flags that an imported image or buffer must have been created with.
  [[nodiscard]] VkImageUsageFlags usage(Texture texture) const;
  [[nodiscard]] VkBufferUsageFlags usage(Buffer buffer) const;

  /// Take over push constants, specialization constants, work group counts and callbacks from a graph of the same
  /// topology (see `sameTopology`), for the frames recorded from now on. Memory, histories and their ages are kept. A
  /// pipeline is created for each new set of values of specialization constants.
  /// @throws std::invalid_argument if the topology differs: compile the graph and create an executor for it;
  ///         PipelineFailed, OutOfMemory or Unsupported, and the executor is unchanged
  void update(const GraphDesc& graph);

  /// Use other SPIR-V for a shader in the frames recorded from now on, also in those of executors that share its
  /// pipelines once they are updated. For programs that reload shaders while they run. Histories are kept.
  /// @param code with the shader's bindings, constants and work group size
  /// @throws PipelineFailed or OutOfMemory, and nothing has changed
  void replaceCode(const Shader& shader, std::vector<std::uint32_t> code);

  /// Record one frame.
  /// @param commandBuffer in the recording state, outside of a render pass
  /// @param slot 0 to framesInFlight - 1; the GPU must have finished the frame last recorded with it
  /// @param finished what the submission of this frame signals; optional. It must live until the slot is used again.
  /// @throws Error naming an import that nothing is bound to
  /// @throws also as `Completions::require` does; then nothing is recorded
  void record(VkCommandBuffer commandBuffer, std::uint32_t slot, const TimelinePoint& finished = {});

  /// Drop the contents of a history: the next frame reads zeros and age 0. For camera cuts.
  void resetHistory(const History& history);
  void resetAllHistory();
  /// Status of a history for the next frame.
  [[nodiscard]] HistoryStatus historyStatus(const History& history) const;

  /// Image or buffer behind a handle in the frame recorded last. For exported resources that are not imports.
  [[nodiscard]] VkImage image(Texture texture) const;
  [[nodiscard]] VkBuffer buffer(Buffer buffer) const;

  /// GPU times of the frame last recorded with a slot, which the GPU must have finished. Valid until the next call;
  /// empty without `ExecutorOptions::timestamps`.
  [[nodiscard]] std::span<const PassTime> passTimes(std::uint32_t slot);
  /// Device memory allocated, in bytes, with that which is shared.
  [[nodiscard]] std::uint64_t allocatedBytes() const;
  /// Bytes of it that other executors use now, too.
  [[nodiscard]] std::uint64_t sharedBytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace fg::vk
