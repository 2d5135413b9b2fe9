#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::check {

/// Check a plan without replaying it: indices, the set of passes, batches, lifetimes, usage flags, places in the heaps,
/// and the layouts of barriers.
/// @return the faults as text
std::vector<std::string> structuralFaults(const GraphDesc& graph, const Plan& plan);

}  // namespace fg::check
