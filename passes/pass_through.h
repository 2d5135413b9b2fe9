#pragma once

#include "framegraph/declare/graph.h"

namespace walr {

/// Copy an RGBA16F texture to the output as it is; alpha becomes 1.
/// @returns the output's new version
fg::Texture addPassThrough(fg::Graph& graph, fg::Texture lighting, fg::Texture output);

}  // namespace walr
