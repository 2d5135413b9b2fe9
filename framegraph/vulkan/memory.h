#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/declare/memory_model.h"
#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// A block of device memory, freed in the destructor. It comes from `DeviceView::memorySource` or else from the driver.
class DeviceMemory {
 public:
  DeviceMemory() = default;
  /// Device-local memory is only a preference: other memory is used if no allowed type is device-local. Host-visible
  /// memory is mapped.
  /// @param properties that the memory must have; device-local: should have
  /// @param user of the memory, for the error message
  /// @throws OutOfMemory, Unsupported if no memory type is suitable, or what the host's source throws
  DeviceMemory(const DeviceContext& device, MemoryRequirements requirements, VkMemoryPropertyFlags properties,
               const std::string& user);
  DeviceMemory(DeviceMemory&& other) noexcept
      : device_(std::exchange(other.device_, nullptr)), size_(other.size_), block_(other.block_) {}
  DeviceMemory& operator=(DeviceMemory&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(size_, other.size_);
    std::swap(block_, other.block_);
    return *this;
  }
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;
  ~DeviceMemory();

  [[nodiscard]] VkDeviceMemory handle() const { return block_.memory; }
  /// Offset of the block in `handle()`.
  [[nodiscard]] std::uint64_t offset() const { return block_.offset; }
  [[nodiscard]] std::byte* mapped() const { return block_.mapped; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  void allocate(const MemoryRequest& request);

  const DeviceContext* device_ = nullptr;  ///< Null if nothing is allocated.
  std::uint64_t size_ = 0;
  MemoryBlock block_;
};

/// Bytes of a block that holds `size` bytes: whole pages of bufferImageGranularity, so that blocks side by side in one
/// allocation of a host share none.
std::uint64_t blockBytes(const DeviceContext& device, std::uint64_t size);

MemoryRequirements memoryRequirements(const DeviceContext& device, VkImage image);
MemoryRequirements memoryRequirements(const DeviceContext& device, VkBuffer buffer);

/// Where images and buffers of equal lifetime lie: one block of memory per set of allowed memory types, in which they
/// lie one after the other.
class ArenaLayout {
 public:
  struct Place {
    std::size_t block = 0;
    std::uint64_t offset = 0;
  };

  /// @param device must outlive the layout
  explicit ArenaLayout(const DeviceContext& device) : device_(&device) {}

  Place add(const MemoryRequirements& requirements);
  /// Requirements of the blocks.
  [[nodiscard]] const std::vector<MemoryRequirements>& blocks() const { return blocks_; }
  /// Bytes that the blocks take.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  const DeviceContext* device_;
  std::vector<MemoryRequirements> blocks_;
};

/// Memory for images and buffers of equal lifetime. Add everything, then allocate once.
class MemoryArena {
 public:
  MemoryArena(const DeviceContext& device, VkMemoryPropertyFlags properties, std::string name)
      : device_(&device), properties_(properties), name_(std::move(name)), layout_(device) {}

  void add(VkImage image);
  /// @param mapped for host-visible arenas: `allocate` stores the address of the buffer's first byte here
  void add(VkBuffer buffer, std::byte** mapped = nullptr);
  /// Allocate, bind and map. Call once.
  void allocate();
  [[nodiscard]] std::uint64_t size() const { return layout_.bytes(); }

 private:
  struct Resident {
    VkImage image = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    std::byte** mapped = nullptr;
    ArenaLayout::Place place;
  };

  const DeviceContext* device_;
  VkMemoryPropertyFlags properties_;
  std::string name_;
  ArenaLayout layout_;
  std::vector<DeviceMemory> blocks_;
  std::vector<Resident> residents_;
};

}  // namespace fg::vk
