#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/conventions/lighting_alpha.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// How features that depend on each other within a block are handled, such as the positions on a single plane.
enum class RankHandling : std::uint8_t {
  Stochastic,     ///< Noise makes the features independent (Koskela et al. 2019, 3.4).
  Deterministic,  ///< No noise: a feature that earlier ones explain is left out of its block's fit.
};

/// Settings of the blockwise feature fit (Koskela et al. 2019, 3.3 and 3.4).
struct BmfrFitSettings {
  RankHandling rankHandling = RankHandling::Stochastic;
  float noiseAmplitude = 0.01F;
  float rankTolerance = 0.01F;
  float extentFloor = 0.05F;

  void visit(SettingVisitor& v) {
    static constexpr std::array<std::string_view, 2> kRankHandlings{"stochastic", "deterministic"};
    v.visitEnum({"fit.rank-handling", "What is done about features that depend on each other within a block", "", 0, 1,
                 "Koskela et al. 2019, 3.4"},
                kRankHandlings, rankHandling);
    v.visit({"fit.noise-amplitude", "Half width of the uniform noise on the features, stochastic handling only",
             "feature range / 2", 1e-3, 1.0, "Koskela et al. 2019, 3.4"},
            noiseAmplitude);
    v.visit({"fit.rank-tolerance",
             "Root mean square of the unexplained part of a feature at which it is left out, deterministic handling "
             "only",
             "feature range / 2", 1e-4, 1.0, "measured"},
            rankTolerance);
    v.visit({"fit.extent-floor", "Smallest extent that a position axis is scaled by", "fraction of the block's largest",
             1e-3, 1.0, "measured"},
            extentFloor);
  }
};

/// Fit the lighting of every block of 32x32 pixels by ten features of first and second order.
/// @param frame    upload of `FrameConstants`; its frame index picks one of 16 displacements of the block grid
/// @param lighting RGBA16F: radiance to fit; pixels that are not finite do not count
/// @param alpha    what the alpha channel of `lighting` holds; pixels without samples do not count
/// @param output   RGBA16F texture to write the fit to
/// @returns the output's new version; sky and pixels without a diffuse lobe hold the pass-through
fg::Texture addBmfrFit(StageGraph graph, fg::Buffer frame, fg::Texture lighting, LightingAlpha alpha,
                       const Guides& guides, fg::Texture output, const BmfrFitSettings& settings = {});

}  // namespace walr
