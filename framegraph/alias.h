#pragma once

#include <cstdint>

#include "framegraph/plan.h"
#include "framegraph/topology.h"

namespace fg {

/// Give every used, aliasable transient an offset in the heap of its memory class, so that no two that are alive at
/// the same time share bytes. The heaps go into `plan.heaps`; imported, exported and history resources get none.
/// Fills in the transient part of `plan.memory` as well.
void placeTransients(const Topology& topology, std::uint64_t bufferImageGranularity, Plan& plan);

}  // namespace fg
