#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Fill in the first and last position at which the ordered passes use each resource.
void findLifetimes(const GraphDesc& graph, std::span<const std::uint32_t> order,
                   std::vector<PlannedResource>& resources);

}  // namespace fg
