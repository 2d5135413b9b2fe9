#pragma once

#include "framegraph/plan/plan.h"

namespace fg {

/// Fill in `plan.traffic` and the persistent bytes of `plan.memory`. `placeTransients` has filled in the transient
/// part.
void report(const GraphDesc& graph, Plan& plan);

}  // namespace fg
