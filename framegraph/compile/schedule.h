#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/compile/cull.h"
#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Batches in the order of execution. Every pass is in a later batch than those that it depends on, and the passes of
/// one batch read a texture only in the same layout, so that one set of barriers before a batch is enough for it.
///
/// There are as few batches as there are passes in the longest chain of dependencies (more only where layouts keep
/// passes apart). A pass that could be in several of them is in the one in which it adds the fewest live bytes, as far
/// as that is known when the batch is filled. There are two list schedules, one from the first batch on and one from
/// the last batch back. The one with fewer batches wins, then the one with the lower peak of live bytes. Ties are
/// broken by pass name, so that the result does not depend on registration.
std::vector<std::vector<std::uint32_t>> schedule(const Topology& topology, const Culling& culling,
                                                 const std::vector<PlannedResource>& resources);

}  // namespace fg
