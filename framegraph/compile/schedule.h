#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/compile/cull.h"
#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Order of execution: every pass comes after those that it depends on, and few transient bytes are alive at any time.
///
/// There are two list schedules, one from the first pass on and one from the last pass back. Each takes the pass next
/// that adds the fewest live bytes. The schedule with the lower peak wins. Ties are broken by pass name, so that the
/// result does not depend on registration.
std::vector<std::uint32_t> schedule(const Topology& topology, const Culling& culling,
                                    const std::vector<PlannedResource>& resources);

}  // namespace fg
