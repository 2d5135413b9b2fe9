#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/compile/cull.h"
#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Order of execution: every pass after those it depends on, with few transient bytes alive at any time.
///
/// Two list schedules are made, one from the front and one from the back, each taking next the pass that adds the
/// fewest live bytes; the one with the lower peak is kept. Ties go by pass name, so that the result is a function of
/// the description alone.
std::vector<std::uint32_t> schedule(const Topology& topology, const Culling& culling,
                                    const std::vector<PlannedResource>& resources);

}  // namespace fg
