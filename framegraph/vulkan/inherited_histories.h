#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::vk {

/// A history and the one of another graph that it inherits, as indices into their `GraphDesc::histories`.
struct InheritedHistory {
  std::uint32_t history = kNone;
  std::uint32_t before = kNone;
};

/// The histories of a graph that can inherit from the graph before. Both plans must use them; name, format, mip levels
/// and layers must be equal; and the old images must have the usage flags that the passes need now. Sizes may differ.
std::vector<InheritedHistory> inheritedHistories(const GraphDesc& graph, const Plan& plan, const GraphDesc& graphBefore,
                                                 const Plan& planBefore);

/// Barriers on `previous` of inherited histories, to be recorded before the first frame: from the state in which the
/// old plan leaves them to the state in which this plan expects them. None if the two are equal.
std::vector<PlannedBarrier> takeOverBarriers(const GraphDesc& graph, const Plan& plan, const Plan& planBefore,
                                             const std::vector<InheritedHistory>& inherited);

}  // namespace fg::vk
