#pragma once

#include <cstdint>

#include "framegraph/graph.h"
#include "passes/prepare_guides.h"

namespace walr {

/// Settings of the spatial filter (walr.txt 3, 4.3, 5).
struct WeightedRegressionSettings {
  /// A-trous iterations with taps 3^t pixels apart; n iterations span a window of 3^n x 3^n pixels. Range 1..5.
  std::uint32_t iterations = 4;
  /// Plane distance, as a fraction of view depth, up to which a pixel counts in full. Range 0..planeFar.
  float planeNear = 0.0015F;
  /// Plane distance, as a fraction of view depth, from which a pixel is an edge. Range planeNear..1.
  float planeFar = 0.015F;
  /// Share of the distance to the nearest edge, as the last iteration saw it, that edge tracing steps at once; 0 walks
  /// pixel by pixel. Range 0..1.
  float sdfFraction = 0.75F;
  /// Replace a tap behind an edge by a random pixel before the edge, so that the tap pattern leaves no seams.
  bool replaceTaps = true;
  /// Added to the diagonal of the covariance of the features, which lie in [0, 1]. Range > 0.
  float ridge = 1e-3F;
  /// Further ridge per unit of relative variance of a sample over the number of samples. Range >= 0.
  float noiseRidge = 3.0F;
};

/// Weighted linear regression of the lighting on the normal over edge-aware a-trous averages.
/// @param frame       upload of `FrameConstants`
/// @param accumulated RGBA16F: radiance to filter
/// @returns RGBA16F: filtered radiance; sky and pixels without a diffuse lobe as they were
/// @throws std::invalid_argument for settings outside their range
fg::Texture addWeightedRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                  const WeightedRegressionSettings& settings = {});

}  // namespace walr
