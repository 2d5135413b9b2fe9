#pragma once

#include "framegraph/graph.h"
#include "passes/inputs.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Declare what a pass that includes reprojection.glsl reads.
void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides);

}  // namespace walr
