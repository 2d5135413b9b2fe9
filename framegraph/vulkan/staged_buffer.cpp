#include "framegraph/vulkan/staged_buffer.h"

#include "framegraph/vulkan/image.h"
#include "framegraph/vulkan/memory_barrier.h"

namespace fg::vk {

StagedBuffer::StagedBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                           std::uint32_t slots, const std::string& name)
    : device_(&device),
      size_(desc.size),
      buffer_(createBuffer(device, desc, usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, name)),
      memory_(device, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "buffer '" + name + "'"),
      stagingMemory_(device, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                     "staging of buffer '" + name + "'"),
      mapped_(slots) {
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    stagingBuffers_.push_back(createBuffer(device, desc, VK_BUFFER_USAGE_TRANSFER_DST_BIT, name));
    stagingMemory_.add(stagingBuffers_.back().get(), &mapped_[slot]);
  }
  memory_.add(buffer_.get());
  memory_.allocate();
  stagingMemory_.allocate();
}

std::span<const std::byte> StagedBuffer::staging(std::uint32_t slot) const {
  return {mapped_[slot], static_cast<std::size_t>(size_)};
}

void StagedBuffer::recordReadback(VkCommandBuffer commandBuffer, std::uint32_t slot) const {
  const VkBufferCopy region{0, 0, size_};
  device_->functions.vkCmdCopyBuffer(commandBuffer, buffer_.get(), stagingBuffers_[slot].get(), 1, &region);
  recordHostVisibility(*device_, commandBuffer);
}

}  // namespace fg::vk
