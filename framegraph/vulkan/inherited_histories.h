#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::vk {

/// A history that goes on from another graph's, by their positions in `GraphDesc::histories`.
struct InheritedHistory {
  std::uint32_t history = kNone;
  std::uint32_t before = kNone;
};

/// The histories of a graph that can go on from those of the graph before: those that both plans use, of the same name,
/// format, mip levels and layers, whose images before allow what the passes do with them now. Sizes may differ.
std::vector<InheritedHistory> inheritedHistories(const GraphDesc& graph, const Plan& plan, const GraphDesc& graphBefore,
                                                 const Plan& planBefore);

/// Barriers on `previous` of inherited histories, to be recorded before the first frame: from the state in which the
/// plan before leaves them to the one from which this plan starts. None where the two are the same.
std::vector<PlannedBarrier> takeOverBarriers(const GraphDesc& graph, const Plan& plan, const Plan& planBefore,
                                             const std::vector<InheritedHistory>& inherited);

}  // namespace fg::vk
