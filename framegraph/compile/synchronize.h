#pragma once

#include "framegraph/compile/access_history.h"
#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Fill in the barriers of `plan.passes`, `plan.releases` and `plan.histories`. The order, the lifetimes and the heap
/// offsets must be final.
void synchronize(const Topology& topology, const AccessHistory& accesses, Plan& plan);

}  // namespace fg
