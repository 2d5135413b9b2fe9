#include "framegraph/compile/frame_border.h"

#include <algorithm>
#include <span>

#include "framegraph/compile/access_history.h"
#include "framegraph/declare/topology.h"

namespace fg {
namespace {

/// Whether a barrier's range covers a subresource.
bool covers(const ResourceDecl& decl, const SubresourceRange& barrier, const SubresourceRange& subresource) {
  const SubresourceRange all = resolved(decl, barrier);
  const SubresourceRange one = resolved(decl, subresource);
  return one.baseMip >= all.baseMip && one.baseMip + one.mipCount <= all.baseMip + all.mipCount &&
         one.baseLayer >= all.baseLayer && one.baseLayer + one.layerCount <= all.baseLayer + all.layerCount;
}

class Borders {
 public:
  Borders(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan), accesses_(graph, plan) {}

  [[nodiscard]] FrameBorder of(std::uint32_t resource) const {
    FrameBorder border;
    if (!plan_.resources[resource].used) return border;
    for (std::uint32_t i = 0; i < accesses_.subresourceCount(resource); ++i) {
      const std::span<const AccessGroup> groups = accesses_.groups(resource, i);
      border.entry.push_back(groups.empty() ? unusedEntry(resource, i) : entry(resource, i, groups.front()));
      border.exit.push_back(groups.empty() ? unusedExit(resource, i) : exit(resource, i, groups.back()));
    }
    return border;
  }

 private:
  [[nodiscard]] const PlannedBarrier* find(const std::vector<PlannedBarrier>& barriers, std::uint32_t resource,
                                           std::uint32_t subresource) const {
    const SubresourceRange range = accesses_.range(resource, subresource);
    const auto found = std::ranges::find_if(barriers, [&](const PlannedBarrier& barrier) {
      return barrier.resource == resource && covers(graph_.resources[resource], barrier.range, range);
    });
    return found == barriers.end() ? nullptr : &*found;
  }

  [[nodiscard]] ExternalState entry(std::uint32_t resource, std::uint32_t subresource, const AccessGroup& first) const {
    for (const PlannedPass& pass : plan_.passes) {
      if (pass.batch > first.batch) break;
      if (const PlannedBarrier* barrier = find(pass.barriers, resource, subresource)) return before(*barrier);
    }
    return {first.stage, first.readMask | first.writeMask, first.layout};
  }

  [[nodiscard]] ExternalState exit(std::uint32_t resource, std::uint32_t subresource, const AccessGroup& last) const {
    const ResourceDecl& decl = graph_.resources[resource];
    if (decl.lifetime == Lifetime::HistoryCurrent) return plan_.histories[decl.history].carry;
    // A barrier after the last use: a release, or one that makes a write available for the memory's next owner.
    if (const PlannedBarrier* barrier = find(plan_.releases, resource, subresource)) return after(*barrier);
    for (const PlannedPass& pass : plan_.passes) {
      if (pass.batch <= last.batch) continue;
      if (const PlannedBarrier* barrier = find(pass.barriers, resource, subresource)) return after(*barrier);
    }
    return {last.stage, last.writeMask, last.layout};
  }

  // A mip level or layer of an import, or a previous history, that no pass uses is released all the same.

  [[nodiscard]] ExternalState unusedEntry(std::uint32_t resource, std::uint32_t subresource) const {
    const PlannedBarrier* barrier = find(plan_.releases, resource, subresource);
    return barrier != nullptr ? before(*barrier) : arrival(resource);
  }

  [[nodiscard]] ExternalState unusedExit(std::uint32_t resource, std::uint32_t subresource) const {
    const PlannedBarrier* barrier = find(plan_.releases, resource, subresource);
    return barrier != nullptr ? after(*barrier) : arrival(resource);
  }

  [[nodiscard]] ExternalState arrival(std::uint32_t resource) const {
    const ResourceDecl& decl = graph_.resources[resource];
    if (decl.lifetime == Lifetime::HistoryPrevious) return plan_.histories[decl.history].carry;
    return decl.acquire.value_or(ExternalState{});
  }

  static ExternalState before(const PlannedBarrier& barrier) {
    return {barrier.srcStage, barrier.srcAccess, barrier.oldLayout};
  }
  static ExternalState after(const PlannedBarrier& barrier) {
    return {barrier.dstStage, barrier.dstAccess, barrier.newLayout};
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  AccessHistory accesses_;
};

}  // namespace

std::vector<FrameBorder> frameBorders(const GraphDesc& graph, const Plan& plan) {
  const Borders borders(graph, plan);
  std::vector<FrameBorder> result;
  for (std::uint32_t i = 0; i < graph.resources.size(); ++i) result.push_back(borders.of(i));
  return result;
}

}  // namespace fg
