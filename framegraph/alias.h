#pragma once

#include <cstdint>

#include "framegraph/access_history.h"
#include "framegraph/plan.h"
#include "framegraph/topology.h"

namespace fg {

/// Last position at which a transient keeps its bytes from others. A write that nobody reads has to be made available
/// before the next owner's layout transition, and barriers of one batch do not order each other: the batch after the
/// writing pass does it (`BarrierReason::Retire`), and the batch after that one may be the next owner's.
std::uint32_t heldUntil(const AccessHistory& accesses, const Plan& plan, std::uint32_t resource);

/// Give every used, aliasable transient an offset in the heap of its memory class, so that no two that are alive at
/// the same time share bytes. The heaps go into `plan.heaps`; imported, exported and history resources get none.
/// Fills in the transient part of `plan.memory` as well.
void placeTransients(const Topology& topology, const AccessHistory& accesses, std::uint64_t bufferImageGranularity,
                     Plan& plan);

}  // namespace fg
