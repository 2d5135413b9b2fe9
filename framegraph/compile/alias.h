#pragma once

#include <cstdint>

#include "framegraph/compile/access_history.h"
#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Last position at which a transient keeps its bytes from others. A write that nobody reads has to be made available
/// before the next owner's layout transition, and barriers of one batch do not order each other: the batch after the
/// writing pass does it (`BarrierReason::Retire`), and the batch after that one may be the next owner's.
std::uint32_t heldUntil(const AccessHistory& accesses, const Plan& plan, std::uint32_t resource);

/// Give every used, aliasable transient an offset in a heap of its memory class, so that no two that are alive at the
/// same time share bytes. The heaps go into `plan.heaps`; imports and exports get none. Fills in the transient part of
/// `plan.memory` as well.
///
/// Histories lie in two heaps of their own that swap roles every frame (`PlannedHeap::partner`), and lend transients
/// what holds nothing there: of `current` before the pass that writes it, of `previous` after the last pass that reads
/// it. Transients take room there first, and only the rest makes a heap of its own; the histories' heaps are no larger
/// than histories need. A history that is exported keeps its memory to itself, as the host may read it after the frame,
/// and so does one whose `previous` nobody reads.
/// @param lendHistories false: histories get no place in a heap, and transients share with each other alone
void placeTransients(const Topology& topology, const AccessHistory& accesses, std::uint64_t bufferImageGranularity,
                     bool lendHistories, Plan& plan);

}  // namespace fg
