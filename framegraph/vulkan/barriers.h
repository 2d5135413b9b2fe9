#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/resources.h"

namespace fg::vk {

/// Planned barriers as one vkCmdPipelineBarrier2. The batch is built once; recording a frame only fills in handles.
///
/// Where memory gets a new owner (`AliasHandOver`), a global memory barrier is recorded beside the image's layout
/// transition: a barrier on the new owner alone does not cover writes to the old one, which is another resource. The
/// layout transition then covers all writes of its source stages, not only pending ones. Synchronization validation
/// (1.3.239) requires this: it forgets an owner's writes only after a later owner of the same kind, image or buffer,
/// has written all of its texels.
class BarrierBatch {
 public:
  BarrierBatch() = default;
  BarrierBatch(const GraphDesc& graph, std::span<const PlannedBarrier> barriers);

  void record(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources, FrameIndex frame);

 private:
  void addImage(const ResourceDecl& resource, const PlannedBarrier& barrier);
  void addBuffer(const PlannedBarrier& barrier);
  void addMemory(const PlannedBarrier& barrier);

  std::vector<VkMemoryBarrier2> memory_;
  std::vector<VkImageMemoryBarrier2> images_;
  std::vector<std::uint32_t> imageResources_;
  std::vector<VkBufferMemoryBarrier2> buffers_;
  std::vector<std::uint32_t> bufferResources_;
};

}  // namespace fg::vk
