#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/memory_model.h"
#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// Allocate from the first memory type that is allowed and has the wanted properties.
/// @param what what the memory is for, for the error's text
/// @throws OutOfMemory, or Unsupported where no memory type fits
Owned<VkDeviceMemory> allocateMemory(const DeviceContext& device, std::uint64_t size, std::uint32_t memoryTypeBits,
                                     VkMemoryPropertyFlags properties, const std::string& what);

MemoryRequirements memoryRequirements(const DeviceContext& device, VkImage image);
MemoryRequirements memoryRequirements(const DeviceContext& device, VkBuffer buffer);

/// Images and buffers that live as long as each other, laid one after the other into one allocation per set of allowed
/// memory types. Add everything, then allocate once.
class MemoryArena {
 public:
  MemoryArena(const DeviceContext& device, VkMemoryPropertyFlags properties, std::string name)
      : device_(&device), properties_(properties), name_(std::move(name)) {}

  void add(VkImage image);
  /// @param mapped receives the buffer's first byte once memory is allocated; for host-visible arenas
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
