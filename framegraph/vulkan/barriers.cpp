#include "framegraph/vulkan/barriers.h"

#include "framegraph/declare/topology.h"
#include "framegraph/vulkan/image.h"

namespace fg::vk {
namespace {

/// A barrier of any of the three kinds with its stages and accesses: the members have the same names in all of them.
template <typename Barrier>
Barrier scopes(VkStructureType type, const PlannedBarrier& planned) {
  Barrier barrier{};
  barrier.sType = type;
  barrier.srcStageMask = planned.srcStage;
  barrier.srcAccessMask = planned.srcAccess;
  barrier.dstStageMask = planned.dstStage;
  barrier.dstAccessMask = planned.dstAccess;
  return barrier;
}

}  // namespace

BarrierBatch::BarrierBatch(const GraphDesc& graph, std::span<const PlannedBarrier> barriers) {
  for (const PlannedBarrier& barrier : barriers) {
    const ResourceDecl& resource = graph.resources[barrier.resource];
    if (barrier.reason == BarrierReason::AliasHandOver) addMemory(barrier);
    if (std::holds_alternative<TextureDesc>(resource.desc)) {
      addImage(resource, barrier);
    } else if (barrier.reason != BarrierReason::AliasHandOver) {
      addBuffer(barrier);
    }
  }
}

void BarrierBatch::addMemory(const PlannedBarrier& barrier) {
  memory_.push_back(scopes<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, barrier));
}

void BarrierBatch::addImage(const ResourceDecl& resource, const PlannedBarrier& planned) {
  auto barrier = scopes<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2, planned);
  if (planned.reason == BarrierReason::AliasHandOver) barrier.srcAccessMask |= VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = planned.oldLayout;
  barrier.newLayout = planned.newLayout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  // A host's image may have more mip levels and layers than it was declared with.
  barrier.subresourceRange =
      subresourceRange(std::get<TextureDesc>(resource.desc).format, resolved(resource, planned.range));
  images_.push_back(barrier);
  imageResources_.push_back(planned.resource);
}

void BarrierBatch::addBuffer(const PlannedBarrier& planned) {
  auto barrier = scopes<VkBufferMemoryBarrier2>(VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2, planned);
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.size = VK_WHOLE_SIZE;
  buffers_.push_back(barrier);
  bufferResources_.push_back(planned.resource);
}

void BarrierBatch::record(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources,
                          FrameIndex frame) {
  if (memory_.empty() && images_.empty() && buffers_.empty()) return;
  for (std::size_t i = 0; i < images_.size(); ++i) images_[i].image = resources.image(imageResources_[i], frame);
  for (std::size_t i = 0; i < buffers_.size(); ++i) buffers_[i].buffer = resources.buffer(bufferResources_[i], frame);
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = static_cast<std::uint32_t>(memory_.size());
  info.pMemoryBarriers = memory_.data();
  info.bufferMemoryBarrierCount = static_cast<std::uint32_t>(buffers_.size());
  info.pBufferMemoryBarriers = buffers_.data();
  info.imageMemoryBarrierCount = static_cast<std::uint32_t>(images_.size());
  info.pImageMemoryBarriers = images_.data();
  device.functions.vkCmdPipelineBarrier2(commandBuffer, &info);
}

}  // namespace fg::vk
