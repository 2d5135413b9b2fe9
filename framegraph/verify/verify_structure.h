#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::check {

/// What is wrong with a plan at sight, without replaying it: indices, the set of passes, lifetimes, usage flags, places
/// in the heaps, stage masks.
std::vector<std::string> structuralFaults(const GraphDesc& graph, const Plan& plan);

}  // namespace fg::check
