#pragma once

#include <cstdint>

#include "framegraph/compile/access_history.h"
#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Last batch in which a transient holds its bytes, so that no other resource may use them. Normally this is the batch
/// of its last use. A write that nobody reads holds the bytes one batch longer: it must be made available before the
/// next owner's layout transition, and barriers of one batch do not order each other. So the batch after the write
/// makes it available (`BarrierReason::Retire`), and the next owner's transition is in a later batch.
std::uint32_t heldUntil(const AccessHistory& accesses, const Plan& plan, std::uint32_t resource);

/// Give every used, aliasable transient an offset in a heap of its memory class, so that no two that are alive in the
/// same batch share bytes. The heaps go into `plan.heaps`; imports and exports get none. Fills in the transient part of
/// `plan.memory`.
///
/// Histories lie in two heaps of their own that swap roles every frame (`PlannedHeap::partner`), no larger than the
/// histories need. Transients alias the parts that hold nothing: the bytes of `current` before the batch that writes
/// it, and those of `previous` after the last batch that reads it. Only transients that do not fit there make a heap of
/// their own. Two kinds of history are not aliased: exported ones, because the host may read them after the frame, and
/// those whose `previous` no pass reads.
/// @param aliasHistories if false, histories get no place in a heap, and transients alias only each other
void placeTransients(const Topology& topology, const AccessHistory& accesses, std::uint64_t bufferImageGranularity,
                     bool aliasHistories, Plan& plan);

}  // namespace fg
