#pragma once

#include "framegraph/graph.h"
#include "passes/denoiser.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Settings of the postprocessing stage (walr.txt 4.4).
struct TemporalAntialiasingSettings {
  /// Number of frames after which the cumulative mean turns exponential. Frames, range 1..255.
  float maxSamples = 8.0F;
  /// Half size of the variance-clipping box in standard deviations of the 3x3 neighbourhood. Range >= 0.
  float clipGamma = 1.0F;
  /// Largest distance of a history pixel from the surface's plane, as a fraction of its view depth. Range 0..1.
  float planeTolerance = 0.01F;
  /// Smallest cosine between the geometric normals of surface and history pixel. Range -1..1.
  float normalThreshold = 0.5F;
};

/// Remove what flicker and aliasing the spatial filter leaves: bicubic history, variance clipping, moving average.
/// @param filtered RGBA16F: the current frame
/// @param output   RGBA16F: texture to write the result to
/// @returns the output's new version
fg::Texture addTemporalAntialiasing(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture filtered, fg::Texture output,
                                    const TemporalAntialiasingSettings& settings = {});

}  // namespace walr
