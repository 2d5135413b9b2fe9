#include "framegraph/vulkan/staged_image.h"

#include "framegraph/declare/format.h"
#include "framegraph/vulkan/image.h"
#include "framegraph/vulkan/memory_barrier.h"

namespace fg::vk {
namespace {

std::uint64_t byteSize(const TextureDesc& desc) {
  return std::uint64_t{bytesPerTexel(desc.format)} * desc.extent.width * desc.extent.height;
}

}  // namespace

StagedImage::StagedImage(const DeviceContext& device, const TextureDesc& desc, VkImageUsageFlags usage,
                         Direction direction, std::uint32_t slots, const std::string& name)
    : device_(&device),
      desc_(desc),
      image_(createImage(
          device, desc,
          usage | (direction == Direction::Upload ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : VK_IMAGE_USAGE_TRANSFER_SRC_BIT),
          name)),
      imageMemory_(device, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "image '" + name + "'"),
      stagingMemory_(device, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                     "staging of image '" + name + "'"),
      mapped_(slots) {
  const VkBufferUsageFlags bufferUsage =
      direction == Direction::Upload ? VK_BUFFER_USAGE_TRANSFER_SRC_BIT : VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    buffers_.push_back(createBuffer(device, {byteSize(desc)}, bufferUsage, name));
    stagingMemory_.add(buffers_.back().get(), &mapped_[slot]);
  }
  imageMemory_.add(image_.get());
  imageMemory_.allocate();
  stagingMemory_.allocate();
}

std::span<std::byte> StagedImage::staging(std::uint32_t slot) const {
  return {mapped_[slot], static_cast<std::size_t>(byteSize(desc_))};
}

VkBufferImageCopy StagedImage::copyRegion() const {
  VkBufferImageCopy region{};
  region.imageSubresource = {aspects(desc_.format), 0, 0, 1};
  region.imageExtent = {desc_.extent.width, desc_.extent.height, 1};
  return region;
}

void StagedImage::recordUpload(VkCommandBuffer commandBuffer, std::uint32_t slot) const {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  // Waits for all reads in the previous frame. Only the graph knows their stages, and it does not export this image. If
  // it reads nothing, the last copy is to be waited for.
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = kUploaded.access;
  barrier.dstStageMask = kUploaded.stage;
  barrier.dstAccessMask = kUploaded.access;
  barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  barrier.newLayout = kUploaded.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image_.get();
  barrier.subresourceRange = subresourceRange(desc_.format, {});
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  device_->functions.vkCmdPipelineBarrier2(commandBuffer, &dependency);
  const VkBufferImageCopy region = copyRegion();
  device_->functions.vkCmdCopyBufferToImage(commandBuffer, buffers_[slot].get(), image_.get(), kUploaded.layout, 1,
                                            &region);
}

void StagedImage::recordReadback(VkCommandBuffer commandBuffer, std::uint32_t slot) const {
  const VkBufferImageCopy region = copyRegion();
  device_->functions.vkCmdCopyImageToBuffer(commandBuffer, image_.get(), kReadable.layout, buffers_[slot].get(), 1,
                                            &region);
  recordHostVisibility(*device_, commandBuffer);
}

}  // namespace fg::vk
