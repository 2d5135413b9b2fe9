#include "framegraph/vulkan/inherited_histories.h"

#include <algorithm>

namespace fg::vk {
namespace {

const TextureDesc& descOf(const GraphDesc& graph, const HistoryDecl& history) {
  return std::get<TextureDesc>(graph.resources[history.current].desc);
}

bool sameButForSize(TextureDesc a, const TextureDesc& b) {
  a.extent = b.extent;
  return a == b;
}

/// Usage flags that `Resources` creates the images of a history with.
VkImageUsageFlags usageOf(const Plan& plan, const HistoryDecl& history) {
  return plan.resources[history.previous].imageUsage | plan.resources[history.current].imageUsage;
}

}  // namespace

std::vector<InheritedHistory> inheritedHistories(const GraphDesc& graph, const Plan& plan, const GraphDesc& graphBefore,
                                                 const Plan& planBefore) {
  std::vector<InheritedHistory> inherited;
  for (std::uint32_t i = 0; i < graph.histories.size(); ++i) {
    const HistoryDecl& history = graph.histories[i];
    const auto before = std::ranges::find(graphBefore.histories, history.name, &HistoryDecl::name);
    if (before == graphBefore.histories.end()) continue;
    const bool used = plan.resources[history.previous].used && planBefore.resources[before->current].used;
    const VkImageUsageFlags needed = plan.resources[history.previous].imageUsage;
    if (!used || !sameButForSize(descOf(graphBefore, *before), descOf(graph, history)) ||
        (needed & ~usageOf(planBefore, *before)) != 0) {
      continue;
    }
    inherited.push_back({i, static_cast<std::uint32_t>(before - graphBefore.histories.begin())});
  }
  return inherited;
}

std::vector<PlannedBarrier> takeOverBarriers(const GraphDesc& graph, const Plan& plan, const Plan& planBefore,
                                             const std::vector<InheritedHistory>& inherited) {
  std::vector<PlannedBarrier> barriers;
  for (const auto& [history, before] : inherited) {
    const ExternalState& from = planBefore.histories[before].carry;
    const ExternalState& to = plan.histories[history].carry;
    if (from == to) continue;
    PlannedBarrier& barrier = barriers.emplace_back();
    barrier.resource = graph.histories[history].previous;
    barrier.reason = BarrierReason::HistoryCarry;
    barrier.srcStage = from.stage;
    barrier.srcAccess = from.access;
    barrier.dstStage = to.stage;
    barrier.dstAccess = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
  }
  return barriers;
}

}  // namespace fg::vk
