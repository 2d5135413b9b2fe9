#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::check {

/// Check a plan without replaying it: indices, the set of passes, lifetimes, usage flags, places in the heaps, stage
/// masks.
/// @return the faults as text
std::vector<std::string> structuralFaults(const GraphDesc& graph, const Plan& plan);

}  // namespace fg::check
