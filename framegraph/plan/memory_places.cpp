#include "framegraph/plan/memory_places.h"

#include <algorithm>

namespace fg {

PassSpan occupied(const GraphDesc& graph, const Plan& plan, std::uint32_t resource) {
  const PlannedResource& planned = plan.resources[resource];
  const auto lastPass = static_cast<std::uint32_t>(plan.passes.size()) - 1;
  switch (graph.resources[resource].lifetime) {
    case Lifetime::HistoryPrevious:
      return {0, planned.lastUse};
    case Lifetime::HistoryCurrent:
      return {planned.firstUse, lastPass};
    default:
      return {planned.firstUse, planned.lastUse};
  }
}

std::vector<std::uint32_t> aliasedHistoryImages(const GraphDesc& graph, const Plan& plan, std::uint32_t resource) {
  std::vector<std::uint32_t> result;
  const PlannedResource& own = plan.resources[resource];
  if (own.heap == kNone || graph.resources[resource].lifetime != Lifetime::Transient) return result;
  for (std::uint32_t i = 0; i < plan.resources.size(); ++i) {
    const PlannedResource& other = plan.resources[i];
    if (other.heap != own.heap || graph.resources[i].lifetime == Lifetime::Transient) continue;
    if (own.offset < other.offset + other.size && other.offset < own.offset + own.size) result.push_back(i);
  }
  std::ranges::sort(result, {}, [&](std::uint32_t i) { return graph.resources[i].name; });
  return result;
}

std::string placeText(const GraphDesc& graph, const Plan& plan, std::uint32_t resource) {
  const PlannedResource& planned = plan.resources[resource];
  if (planned.heap == kNone) return {};
  std::string text = "heap " + std::to_string(planned.heap) + " [" + std::to_string(planned.offset) + ", " +
                     std::to_string(planned.offset + planned.size) + ")";
  const char* join = " of ";
  for (const std::uint32_t image : aliasedHistoryImages(graph, plan, resource)) {
    text += join + graph.resources[image].name;
    join = " and ";
  }
  return text;
}

}  // namespace fg
