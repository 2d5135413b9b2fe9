#pragma once

#include "framegraph/declare/graph.h"
#include "passes/inputs.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Which object every pixel shows, to tell the histories of two by (Wang 2024, 3): R32_UINT, the host's
/// number
/// + 1, and 0 where there is none.
struct ObjectIds {
  fg::Texture current;
  fg::Texture previous;  ///< One frame ago; 0 while there is no history.
};

/// Keep the host's object numbers for the next frame; `inputs.objectId` must be there.
ObjectIds addObjectIds(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides);

}  // namespace walr
