#pragma once

#include <span>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Fill in the first and last position at which the ordered passes use each resource.
void findLifetimes(const GraphDesc& graph, std::span<const PlannedPass> order, std::vector<PlannedResource>& resources);

}  // namespace fg
