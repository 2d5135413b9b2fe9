#include "framegraph/vulkan/history_state.h"

#include <algorithm>
#include <limits>

namespace fg::vk {

HistoryStates::HistoryStates(const GraphDesc& graph, const Plan& plan) : ages_(graph.histories.size()) {
  for (std::uint32_t i = 0; i < graph.histories.size(); ++i) {
    written_.push_back(plan.resources[graph.histories[i].current].used);
    clears_.push_back(historyClear(graph, plan, i));
  }
}

void HistoryStates::resetAll() {
  std::ranges::fill(ages_, 0u);
}

void HistoryStates::recordClears(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources,
                                 FrameIndex frame) {
  for (std::size_t i = 0; i < clears_.size(); ++i) {
    if (ages_[i] == 0) clears_[i].record(device, commandBuffer, resources, frame);
  }
}

void HistoryStates::advance() {
  for (std::size_t i = 0; i < ages_.size(); ++i) {
    if (written_[i] && ages_[i] != std::numeric_limits<std::uint32_t>::max()) ++ages_[i];
  }
}

}  // namespace fg::vk
