#pragma once

#include "framegraph/graph.h"
#include "passes/history_tests.h"
#include "passes/inputs.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Declare what a pass that includes reprojection.glsl reads.
/// @param rejection    the one that the pass's shader is made for
/// @param dilateMotion follow the nearest surface of the 3x3 neighbourhood (walr.txt 4.2)
void readReprojection(fg::PassBuilder& pass, const DenoiserInputs& inputs, const Guides& guides,
                      HistoryRejection rejection, bool dilateMotion = false);

}  // namespace walr
