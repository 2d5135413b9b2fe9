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
  /// Measured from the end of the previous pass, so it includes the barriers. Passes of one batch
  /// (`PlannedPass::batch`) may overlap: the sum of their times is right, its parts are not.
  double milliseconds = 0.0;
};

/// Time between two timestamps of a device's queue family.
double millisecondsBetween(const DeviceContext& device, std::uint64_t firstTick, std::uint64_t lastTick);

/// GPU timestamps between the passes, for every frame slot.
class Timestamps {
 public:
  /// @throws Unsupported if the queue family has no timestamps
  Timestamps(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots);

  void begin(VkCommandBuffer commandBuffer, std::uint32_t slot);
  /// Record the end of the pass at this position of the plan.
  void endPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t plannedPass);
  /// Times of the frame last recorded with the slot, which the GPU must have finished. Empty if there is none.
  std::span<const PassTime> read(std::uint32_t slot);

 private:
  void write(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t query);

  const DeviceContext* device_;
  std::uint32_t queryCount_;
  std::vector<Owned<VkQueryPool>> pools_;
  std::vector<bool> recorded_;  ///< Indexed by slot.
  std::vector<std::uint64_t> ticks_;
  std::vector<PassTime> times_;
};

}  // namespace fg::vk
