#pragma once

#include "framegraph/graph.h"
#include "passes/denoiser.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Settings of the preprocessing accumulation (walr.txt 4.2).
struct TemporalAccumulationSettings {
  /// Number of samples after which the cumulative mean turns exponential. Frames, range 1..255.
  float maxSamples = 16.0F;
  /// Largest distance of a history pixel from the surface's plane, as a fraction of its view depth. Range 0..1.
  float planeTolerance = 0.01F;
  /// Smallest cosine between the geometric normals of surface and history pixel. Range -1..1.
  float normalThreshold = 0.5F;
};

/// Average the noisy lighting over time along its motion.
/// @returns RGBA16F: mean radiance; alpha: number of samples behind it, 0 where there is nothing to denoise.
fg::Texture addTemporalAccumulation(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    const TemporalAccumulationSettings& settings = {});

}  // namespace walr
