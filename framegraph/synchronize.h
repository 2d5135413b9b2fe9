#pragma once

#include "framegraph/plan.h"
#include "framegraph/topology.h"

namespace fg {

/// Fill in the barriers of `plan.passes`, `plan.releases` and `plan.histories`. The order, the lifetimes and the heap
/// offsets must stand.
void synchronize(const Topology& topology, Plan& plan);

}  // namespace fg
