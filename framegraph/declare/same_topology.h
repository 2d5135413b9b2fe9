#pragma once

#include "framegraph/declare/graph.h"

namespace fg {

/// True if two descriptions have the same plan. They may then differ only in what a plan does not contain: values of
/// push constants and of specialization constants, work group counts, callbacks and source locations.
/// `vk::Executor::update` adopts such differences without a new plan.
bool sameTopology(const GraphDesc& a, const GraphDesc& b);

}  // namespace fg
