#pragma once

#include <cstddef>
#include <cstdint>

#include <vulkan/vulkan_core.h>

namespace fg::vk {

/// What a block of device memory must be like.
struct MemoryRequest {
  std::uint64_t size = 0;       ///< Bytes; a multiple of bufferImageGranularity.
  std::uint64_t alignment = 1;  ///< Of the block's offset; a multiple of bufferImageGranularity.
  std::uint32_t memoryTypeBits = ~0U;
  VkMemoryPropertyFlags required = 0;
  VkMemoryPropertyFlags preferred = 0;
  const char* user = "";  ///< What uses the memory, for messages and captures.
};

/// A block of device memory: a whole allocation, or a part of one.
struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  std::uint64_t offset = 0;
  std::byte* mapped = nullptr;  ///< Address of the block's first byte; null unless host-visible memory was required.
  void* token = nullptr;        ///< The source's own.
};

/// A host's own source of device memory, used in place of vkAllocateMemory.
class MemorySource {
 public:
  virtual ~MemorySource() = default;
  /// @throws an exception if there is no such memory; the library passes it on and releases what it has made
  virtual MemoryBlock allocate(const MemoryRequest& request) = 0;
  virtual void free(const MemoryBlock& block) noexcept = 0;
};

}  // namespace fg::vk
