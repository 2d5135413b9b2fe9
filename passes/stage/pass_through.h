#pragma once

#include "framegraph/declare/graph.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Copy an RGBA16F texture to the output; values that are not finite become 0, alpha becomes 1.
/// @returns the output's new version
fg::Texture addPassThrough(StageGraph graph, fg::Texture lighting, fg::Texture output);

}  // namespace walr
