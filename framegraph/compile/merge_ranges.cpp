#include "framegraph/compile/merge_ranges.h"

#include <algorithm>

#include "framegraph/declare/topology.h"

namespace fg {
namespace {

using Placed = std::pair<std::uint32_t, PlannedBarrier>;

bool alike(const Placed& a, const Placed& b) {
  PlannedBarrier other = b.second;
  other.range = a.second.range;
  return a.first == b.first && a.second == other;
}

bool nextLayers(const SubresourceRange& a, const SubresourceRange& b) {
  return a.baseMip == b.baseMip && a.mipCount == b.mipCount && a.baseLayer + a.layerCount == b.baseLayer;
}

bool nextMips(const SubresourceRange& a, const SubresourceRange& b) {
  return a.baseLayer == b.baseLayer && a.layerCount == b.layerCount && a.baseMip + a.mipCount == b.baseMip;
}

/// Extend each barrier by the later ones that continue its range, and drop those.
template <typename Continues, typename Grow>
void absorb(std::vector<Placed>& barriers, Continues continues, Grow grow) {
  std::vector<Placed> kept;
  for (const Placed& barrier : barriers) {
    const auto grown = std::ranges::find_if(kept, [&](const Placed& other) {
      return alike(other, barrier) && continues(other.second.range, barrier.second.range);
    });
    if (grown == kept.end()) {
      kept.push_back(barrier);
    } else {
      grow(grown->second.range, barrier.second.range);
    }
  }
  barriers = std::move(kept);
}

}  // namespace

void mergeRanges(const ResourceDecl& resource, std::vector<Placed>& barriers) {
  absorb(barriers, nextLayers, [](SubresourceRange& a, const SubresourceRange& b) { a.layerCount += b.layerCount; });
  absorb(barriers, nextMips, [](SubresourceRange& a, const SubresourceRange& b) { a.mipCount += b.mipCount; });
  for (auto& [batch, barrier] : barriers) {
    if (coversAll(resource, barrier.range)) barrier.range = {};
  }
}

}  // namespace fg
