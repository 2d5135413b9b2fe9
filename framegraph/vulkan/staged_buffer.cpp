#include "framegraph/vulkan/staged_buffer.h"

#include <algorithm>

#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/image.h"
#include "framegraph/vulkan/memory_barrier.h"

namespace fg::vk {
namespace {

constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
constexpr VkBufferUsageFlags kStaging = VK_BUFFER_USAGE_TRANSFER_DST_BIT;

}  // namespace

std::uint64_t StagedBuffer::requiredBytes(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                                          std::uint32_t slots) {
  const DriverMemoryModel model(device);
  ArenaLayout memory(device);
  memory.add(model.buffer(desc, usage | kCopied));
  ArenaLayout staging(device);
  for (std::uint32_t slot = 0; slot < slots; ++slot) staging.add(model.buffer(desc, kStaging));
  return memory.bytes() + staging.bytes();
}

StagedBuffer::StagedBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                           std::uint32_t slots, const std::string& name)
    : device_(&device),
      size_(desc.size),
      memory_(device, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "buffer '" + name + "'"),
      buffer_(createBuffer(device, desc, usage | kCopied, name)),
      stagingMemory_(device, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                     "staging of buffer '" + name + "'"),
      mapped_(slots) {
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    stagingBuffers_.push_back(createBuffer(device, desc, kStaging, name));
    stagingMemory_.add(stagingBuffers_.back().get(), &mapped_[slot]);
  }
  memory_.add(buffer_.get());
  memory_.allocate();
  stagingMemory_.allocate();
}

std::span<const std::byte> StagedBuffer::staging(std::uint32_t slot) const {
  return {mapped_[slot], static_cast<std::size_t>(size_)};
}

void StagedBuffer::clearStaging(std::uint32_t slot) {
  std::fill_n(mapped_[slot], size_, std::byte{0});
}

void StagedBuffer::recordReadback(VkCommandBuffer commandBuffer, std::uint32_t slot) const {
  const VkBufferCopy region{0, 0, size_};
  device_->functions.vkCmdCopyBuffer(commandBuffer, buffer_.get(), stagingBuffers_[slot].get(), 1, &region);
  recordHostVisibility(*device_, commandBuffer);
}

}  // namespace fg::vk
