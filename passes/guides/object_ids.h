#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// The object that every pixel shows, to tell the histories of different objects apart (Wang 2024, 3). R32_UINT: the
/// host's object id + 1, or 0 where there is none.
struct ObjectIds {
  fg::Texture current;
  fg::Texture previous;  ///< One frame ago; 0 while there is no history.
};

/// Keep the host's object ids for the next frame; `inputs.objectId` must be valid.
ObjectIds addObjectIds(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides);

}  // namespace walr
