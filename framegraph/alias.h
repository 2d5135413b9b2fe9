#pragma once

#include <cstdint>

#include "framegraph/access_history.h"
#include "framegraph/plan.h"
#include "framegraph/topology.h"

namespace fg {

/// Give every used, aliasable transient an offset in the heap of its memory class, so that no two that are alive at
/// the same time share bytes. The heaps go into `plan.heaps`; imported, exported and history resources get none.
/// A transient whose last access writes keeps its bytes for the whole frame: no barrier of the next owner would cover
/// what was written through another resource, and no reader has made it available.
/// Fills in the transient part of `plan.memory` as well.
void placeTransients(const Topology& topology, const AccessHistory& accesses, std::uint64_t bufferImageGranularity,
                     Plan& plan);

}  // namespace fg
