#pragma once

#include "framegraph/declare/graph.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// What the filter over lobes reads.
struct LobeFilterInputs {
  fg::Buffer frame;         ///< Upload of `FrameConstants`.
  fg::Texture depth;        ///< `Guides::depth`.
  fg::Texture reflectors;   ///< `ReflectionMotion::reflectors` with mean distances.
  fg::Texture accumulated;  ///< RGBA16F or packed: mean radiance; alpha: history length.
  fg::Texture lighting;     ///< This frame's noisy specular light.
  fg::Texture antilag;      ///< `AccumulatedLight::antilag`, or not valid.
  float maxHistory;         ///< Frames: the longest history of accumulation.
};

/// Three edge-avoiding a-trous iterations over accumulated specular light, weighted by how far lobes cover the same
/// things (passes/SPECULAR.md).
/// @param target texture for the filtered light, RGBA16F or packed
/// @returns its new version
fg::Texture addLobeFilter(StageGraph graph, const LobeFilterInputs& inputs, fg::Texture target);

}  // namespace walr
