#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/memory_model.h"
#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// Allocate from the first allowed memory type that has these properties. Device-local memory is only a preference:
/// other memory is used if no allowed type is device-local.
/// @param what user of the memory, for the error message
/// @throws OutOfMemory, or Unsupported if no memory type is suitable
Owned<VkDeviceMemory> allocateMemory(const DeviceContext& device, std::uint64_t size, std::uint32_t memoryTypeBits,
                                     VkMemoryPropertyFlags properties, const std::string& what);

MemoryRequirements memoryRequirements(const DeviceContext& device, VkImage image);
MemoryRequirements memoryRequirements(const DeviceContext& device, VkBuffer buffer);

/// Memory for images and buffers of equal lifetime: one allocation per set of allowed memory types, in which they lie
/// one after the other. Add everything, then allocate once.
class MemoryArena {
 public:
  MemoryArena(const DeviceContext& device, VkMemoryPropertyFlags properties, std::string name)
      : device_(&device), properties_(properties), name_(std::move(name)) {}

  void add(VkImage image);
  /// @param mapped for host-visible arenas: `allocate` stores the address of the buffer's first byte here
  void add(VkBuffer buffer, std::byte** mapped = nullptr);
  /// Allocate, bind and map. Call once.
  void allocate();
  [[nodiscard]] std::uint64_t size() const;

 private:
  struct Block {
    std::uint32_t memoryTypeBits = 0;
    std::uint64_t size = 0;
    Owned<VkDeviceMemory> memory;
    std::byte* mapped = nullptr;
  };
  struct Resident {
    VkImage image = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    std::byte** mapped = nullptr;
    std::size_t block = 0;
    std::uint64_t offset = 0;
  };
  void place(const MemoryRequirements& requirements, Resident resident);

  const DeviceContext* device_;
  VkMemoryPropertyFlags properties_;
  std::string name_;
  std::vector<Block> blocks_;
  std::vector<Resident> residents_;
};

}  // namespace fg::vk
