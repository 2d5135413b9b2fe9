#pragma once

#include <cstdint>

#include "framegraph/graph.h"
#include "passes/prepare_guides.h"
#include "passes/settings.h"

namespace walr {

/// Settings of the spatial filter (walr.txt 3, 4.3, 5).
struct WeightedRegressionSettings {
  std::uint32_t iterations = 4;
  float planeNear = 0.0015F;
  float planeFar = 0.015F;
  float sdfFraction = 0.75F;
  bool replaceTaps = true;
  float ridge = 1e-3F;
  float noiseRidge = 3.0F;

  void visit(SettingVisitor& v) {
    v.visit({"regression.iterations", "A-trous iterations with taps 3^t pixels apart; n of them span 3^n x 3^n pixels",
             "", 1, 5, "walr.txt 3.2"},
            iterations);
    v.visit({"regression.plane-near", "Distance from the plane up to which a pixel counts in full; below plane-far",
             "fraction of depth", 0.0, 1.0, "walr.txt 4.3"},
            planeNear);
    v.visit({"regression.plane-far", "Distance from the plane from which a pixel is an edge", "fraction of depth", 1e-6,
             1.0, "walr.txt 4.3"},
            planeFar);
    v.visit({"regression.sdf-fraction",
             "Share of the distance to the nearest edge that edge tracing steps at once; 0 walks pixel by pixel", "",
             0.0, 1.0, "walr.txt 5.2"},
            sdfFraction);
    v.visit({"regression.replace-taps", "Replace a tap behind an edge by a random pixel before it", "", 0, 1,
             "walr.txt 3.3"},
            replaceTaps);
    v.visit({"regression.ridge", "Added to the diagonal of the covariance of the features, which lie in 0..1", "", 1e-9,
             1.0, "measured"},
            ridge);
    v.visit({"regression.noise-ridge", "Further ridge per unit of relative variance of a sample over the sample count",
             "", 0.0, 1e3, "measured"},
            noiseRidge);
  }
};

/// Weighted linear regression of the lighting on the normal over edge-aware a-trous averages.
/// @param frame       upload of `FrameConstants`
/// @param accumulated RGBA16F: radiance to filter
/// @returns RGBA16F: filtered radiance; sky and pixels without a diffuse lobe as they were
/// @throws std::invalid_argument for settings outside their range
fg::Texture addWeightedRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                  const WeightedRegressionSettings& settings = {});

}  // namespace walr
