#pragma once

#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// States of one resource at the border between two frames, for hosts that execute a plan themselves. There is one
/// state per mip level of an array layer, at index mip * layers + layer. A buffer has one, and so has a history
/// whatever its levels and layers. A resource that no pass uses has none.
struct FrameBorder {
  /// State that the resource must have before the first barrier of a frame: what this barrier starts from, or what the
  /// first use needs if no barrier comes before it. A barrier that leads there has it as its destination. A layout of
  /// UNDEFINED means that the contents may be discarded. A history's `previous` must hold zeros in this state if there
  /// is no last frame.
  std::vector<ExternalState> entry;
  /// State in which the frame leaves it, after all passes and `Plan::releases`: the last stages and the accesses that a
  /// barrier must start from. That of a history's `current` is `PlannedHistory::carry`, and is the entry of `previous`
  /// in the next frame.
  std::vector<ExternalState> exit;
};

/// The borders of all resources, read off the plan's barriers and the passes' accesses.
/// @return indexed by resource
std::vector<FrameBorder> frameBorders(const GraphDesc& graph, const Plan& plan);

}  // namespace fg
