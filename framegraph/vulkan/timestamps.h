#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// GPU time of one pass.
struct PassTime {
  std::string name;
  double milliseconds = 0.0;  ///< From the end of the pass before, so barriers count to the pass that waits.
};

/// GPU timestamps between the passes, by frame slot.
class Timestamps {
 public:
  /// @throws Unsupported where the queue family has no timestamps
  Timestamps(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots);

  void begin(VkCommandBuffer commandBuffer, std::uint32_t slot);
  /// The end of the pass at this position of the plan.
  void endPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t plannedPass);
  /// Times of the frame last recorded with the slot; the GPU must have finished it. Empty where there is none.
  std::span<const PassTime> read(std::uint32_t slot);

 private:
  void write(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t query);

  const DeviceContext* device_;
  std::uint32_t queryCount_;
  std::vector<Owned<VkQueryPool>> pools_;
  std::vector<bool> recorded_;  ///< By slot.
  std::vector<std::uint64_t> ticks_;
  std::vector<PassTime> times_;
};

}  // namespace fg::vk
