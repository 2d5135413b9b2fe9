#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/memory.h"

namespace fg::vk {

/// A host's buffer with staging memory for every frame slot, so that what a frame left in it is read while other frames
/// are in flight. Import it as `kOverwritable` and export it as `kReadable` (staged_image.h).
class StagedBuffer {
 public:
  /// @param usage what the graph does with it (see `Executor::usage`); the transfer is added
  /// @throws OutOfMemory
  StagedBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage, std::uint32_t slots,
               const std::string& name);

  [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
  /// To be read once the frame of `recordReadback` is finished, and until the slot is used again.
  [[nodiscard]] std::span<const std::byte> staging(std::uint32_t slot) const;
  void recordReadback(VkCommandBuffer commandBuffer, std::uint32_t slot) const;

 private:
  const DeviceContext* device_;
  std::uint64_t size_;
  Owned<VkBuffer> buffer_;
  MemoryArena memory_;
  MemoryArena stagingMemory_;
  std::vector<Owned<VkBuffer>> stagingBuffers_;
  std::vector<std::byte*> mapped_;
};

}  // namespace fg::vk
