#include "integration/c_api/count_buffer.h"

#include <algorithm>
#include <span>

#include "framegraph/vulkan/memory_barrier.h"

namespace walr::api {

CountBuffer::CountBuffer(const fg::vk::DeviceContext& device, std::uint64_t bytes, VkBufferUsageFlags usage,
                         std::uint32_t slots, const std::string& name)
    : device_(&device), words_(bytes / sizeof(std::uint32_t)), buffer_(device, {bytes}, usage, slots, name) {}

std::uint64_t CountBuffer::requiredBytes(const fg::vk::DeviceContext& device, std::uint64_t bytes,
                                         VkBufferUsageFlags usage, std::uint32_t slots) {
  return fg::vk::StagedBuffer::requiredBytes(device, {bytes}, usage, slots);
}

std::vector<std::uint32_t> CountBuffer::take(std::uint32_t slot) {
  std::vector<std::uint32_t> words(words_);
  std::ranges::copy(buffer_.staging(slot), std::as_writable_bytes(std::span(words)).begin());
  buffer_.clearStaging(slot);
  return words;
}

void CountBuffer::recordBefore(VkCommandBuffer commandBuffer) const {
  fg::vk::recordMemoryBarrier(*device_, commandBuffer, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_NONE},
                              {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
}

void CountBuffer::recordBetween(VkCommandBuffer commandBuffer) const {
  constexpr VkAccessFlags2 kCount = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  fg::vk::recordMemoryBarrier(*device_, commandBuffer,
                              {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                              {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, kCount});
}

void CountBuffer::recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot) const {
  fg::vk::recordMemoryBarrier(*device_, commandBuffer,
                              {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                              {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
  buffer_.recordReadback(commandBuffer, slot);
}

}  // namespace walr::api
