#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framegraph/vulkan/staged_buffer.h"

namespace walr::api {

/// A buffer of words that passes of a frame clear and then count into. The counts of a frame are read
/// once the GPU has finished it, while other frames are in flight.
class CountBuffer {
 public:
  /// @param bytes  of the graph's import that receives the counts
  /// @param usage  its usage flags
  /// @param device must outlive the object
  CountBuffer(const fg::vk::DeviceContext& device, std::uint64_t bytes, VkBufferUsageFlags usage, std::uint32_t slots,
              const std::string& name);

  /// Bytes of device memory that a CountBuffer allocates.
  static std::uint64_t requiredBytes(const fg::vk::DeviceContext& device, std::uint64_t bytes, VkBufferUsageFlags usage,
                                     std::uint32_t slots);
  [[nodiscard]] std::uint64_t allocatedBytes() const { return buffer_.allocatedBytes(); }
  [[nodiscard]] VkBuffer handle() const { return buffer_.handle(); }

  /// Take the words of the frame recorded last with a slot, which the GPU must have finished. All are zero if it was
  /// never executed.
  std::vector<std::uint32_t> take(std::uint32_t slot);
  /// Record before the graph, or before the pass that clears the counters.
  void recordBefore(VkCommandBuffer commandBuffer) const;
  /// Record between the passes that clear the counters and that count, if no graph places their barrier.
  void recordBetween(VkCommandBuffer commandBuffer) const;
  /// Record after the graph, or after the pass that counts last.
  void recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot) const;

 private:
  const fg::vk::DeviceContext* device_;
  std::size_t words_;
  fg::vk::StagedBuffer buffer_;
};

}  // namespace walr::api
