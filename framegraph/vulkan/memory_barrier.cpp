#include "framegraph/vulkan/memory_barrier.h"

namespace fg::vk {

void recordMemoryBarrier(const DeviceContext& device, VkCommandBuffer commandBuffer, const ExternalState& before,
                         const ExternalState& after) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = before.stage;
  barrier.srcAccessMask = before.access;
  barrier.dstStageMask = after.stage;
  barrier.dstAccessMask = after.access;
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &barrier;
  device.functions.vkCmdPipelineBarrier2(commandBuffer, &dependency);
}

void recordHostVisibility(const DeviceContext& device, VkCommandBuffer commandBuffer) {
  recordMemoryBarrier(device, commandBuffer, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                      {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

}  // namespace fg::vk
