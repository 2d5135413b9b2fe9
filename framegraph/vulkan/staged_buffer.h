#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/memory.h"

namespace fg::vk {

/// A host's buffer with staging memory for every frame slot, so that the host can read a frame's result while other
/// frames are in flight. Import it as `kOverwritable` and export it as `kReadable` (staged_image.h).
class StagedBuffer {
 public:
  /// @param usage usage flags that the graph needs (see `Executor::usage`); those of the transfer are added
  /// @throws OutOfMemory
  StagedBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage, std::uint32_t slots,
               const std::string& name);

  /// Bytes of device memory that a StagedBuffer allocates. Nothing is allocated to find out.
  static std::uint64_t requiredBytes(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                                     std::uint32_t slots);
  [[nodiscard]] std::uint64_t allocatedBytes() const { return memory_.size() + stagingMemory_.size(); }

  [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
  /// Contents to read after the frame of `recordReadback` has finished, until the slot is used again.
  [[nodiscard]] std::span<const std::byte> staging(std::uint32_t slot) const;
  /// Set the contents of `staging` to zero, so that they tell whether a frame was executed after it was recorded.
  /// Call it only when no frame in flight uses the slot.
  void clearStaging(std::uint32_t slot);
  void recordReadback(VkCommandBuffer commandBuffer, std::uint32_t slot) const;

 private:
  const DeviceContext* device_;
  std::uint64_t size_;
  MemoryArena memory_;
  Owned<VkBuffer> buffer_;
  MemoryArena stagingMemory_;
  std::vector<Owned<VkBuffer>> stagingBuffers_;
  std::vector<std::byte*> mapped_;
};

}  // namespace fg::vk
