#pragma once

#include "framegraph/declare/graph.h"

namespace fg {

/// True where two descriptions have one plan: where they differ at most in what is only recorded, which is values of
/// push constants and of specialization constants, work group counts, callbacks, and where in the source it all stands.
/// `vk::Executor::update` takes such differences over as they are.
bool sameTopology(const GraphDesc& a, const GraphDesc& b);

}  // namespace fg
