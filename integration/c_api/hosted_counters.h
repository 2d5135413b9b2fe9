#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <walr/walr.h>

#include "integration/c_api/count_buffer.h"
#include "passes/stage/inspection.h"

namespace walr::api {

/// The counters of a method while a host renders: read for each frame once the GPU has finished it.
class HostedCounters {
 public:
  /// @param usage    usage flags of the graph's import that receives the counters
  /// @param counters of the graph
  /// @param device   must outlive the object
  HostedCounters(const fg::vk::DeviceContext& device, VkBufferUsageFlags usage, std::vector<Counter> counters,
                 std::uint32_t slots)
      : buffer_(device, kCounterBytes, usage, slots, "counters"), counters_(std::move(counters)), pending_(slots) {}

  /// The buffer that receives the counters.
  [[nodiscard]] const CountBuffer& buffer() const { return buffer_; }

  /// Read the counters of the frame recorded last with a slot. The GPU must have finished it.
  void collect(std::uint32_t slot) {
    if (!pending_[slot]) return;
    pending_[slot] = false;
    const std::vector<std::uint32_t> words = buffer_.take(slot);
    values_.clear();
    for (const Counter& counter : counters_) values_.push_back({counter.name.c_str(), counter.value(words)});
  }
  /// Record after the graph.
  void recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot) {
    buffer_.recordAfter(commandBuffer, slot);
    pending_[slot] = true;
  }

  /// Counters of the frame that was read last; empty if none was.
  [[nodiscard]] const std::vector<WalrCounter>& values() const { return values_; }

 private:
  CountBuffer buffer_;
  std::vector<Counter> counters_;
  std::vector<bool> pending_;  ///< By slot.
  std::vector<WalrCounter> values_;
};

}  // namespace walr::api
