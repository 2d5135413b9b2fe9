#pragma once

#include "framegraph/plan/plan.h"

namespace fg {

/// Fill in the persistent bytes of `plan.memory` (the transient ones come with the placement), and `plan.traffic`.
void report(const GraphDesc& graph, Plan& plan);

}  // namespace fg
