#pragma once

#include <cstdint>
#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/conventions/light_pattern.h"
#include "passes/conventions/light_storage.h"
#include "passes/conventions/lighting_alpha.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/accumulated_share.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"

namespace walr {

/// Settings of the regression over blocks of pixels (passes/WALR.md, 4 to 8).
struct BlockRegressionSettings {
  std::uint32_t size = 8;
  std::uint32_t iterations = 4;
  float planeNear = 0.0015F;
  float planeFar = 0.015F;
  float sdfFraction = 0.75F;
  float ridge = 1e-4F;
  float growthErrors = 6.0F;
  float coarseSigma = 0.0224F;
  float coarseNarrowing = 0.6F;
  float coarseReach = 3.0F;
  float coarseResolution = 1.1F;
  float coarseGrowthErrors = 2.0F;
  float coarseGrowthOcclusion = 4.0F;
  float coarseSamples = 3200.0F;
  float coarseLeastShare = 0.15F;
  AccumulatedShareSettings share = {};

  void visit(SettingVisitor& v) {
    v.visit({"blocks.size", "Side of the blocks whose moments are averaged", "pixels", 2, 8, "measured"}, size);
    v.visit({"blocks.iterations", "A-trous iterations with taps 3^t blocks apart; n of them span 3^n blocks", "", 1, 4,
             "Meunier & Harada 2022, 3.2"},
            iterations);
    v.visit({"blocks.plane-near", "Distance from the plane up to which a block counts in full; below plane-far",
             "fraction of depth", 0.0, 1.0, "Meunier & Harada 2022, 4.3"},
            planeNear);
    v.visit({"blocks.plane-far", "Distance from the plane at which an edge begins", "fraction of depth", 1e-6, 1.0,
             "Meunier & Harada 2022, 4.3"},
            planeFar);
    v.visit(
        {"blocks.growth-errors",
         "Growth of fine fits: a block joins another's window in full up to this difference of their mean luminances, "
         "and not at all from twice as much on. The errors are those of means of W samples with the pixels' variance",
         "standard errors", 0.001, 1e6, "measured"},
        growthErrors);
    v.visit(
        {"blocks.coarse-sigma",
         "Standard deviation of the Gaussian window of the coarse fit, which no edge stops, at one sample per texel of "
         "accumulated light",
         "fraction of the image's height", 0.001, 0.2, "measured"},
        coarseSigma);
    v.visit({"blocks.coarse-narrowing",
             "The coarse window narrows with this power of the samples per texel of accumulated light; 0: not at all",
             "", 0.0, 1.0, "measured"},
            coarseNarrowing);
    v.visit({"blocks.coarse-growth-errors",
             "Growth of coarse fits: a window joins a cell's in full if the cell's fit predicts its mean light within "
             "this error, and not at all from twice as much on",
             "standard errors", 0.001, 1e6, "measured"},
            coarseGrowthErrors);
    v.visit(
        {"blocks.coarse-samples",
         "Samples that the coarse fit counts for in the mixture with a fine fit of W samples; in pictures higher than "
         "360 pixels it is divided by (height / 360)^2",
         "samples", 0.0, 1e6, "measured"},
        coarseSamples);
    share.visit(v);
  }
};

/// Samples that the coarse fit counts for in a picture of this height in pixels. Up to 360 it is the setting
/// `BlockRegressionSettings::coarseSamples`; above, that is divided by the square of height / 360. From there to
/// 1,246 fine windows have a fixed size in pixels (`fittingIterations`), so that they show less of the scene in a
/// larger picture, and miss less of its light. Coarse windows are a fixed share of the picture. Above 1,246 this was
/// not measured.
float coarseSamplesAt(std::uint32_t height, float coarseSamples);

/// Antilag of a frame's own accumulated light.
struct CurrentAntilag {
  fg::Texture factor;  ///< `AccumulatedLight::antilag`.
  float maxHistory;    ///< Frames: `TemporalAccumulationSettings::maxHistory`.
};

/// The light that the regression over blocks fits.
struct BlockLight {
  fg::Texture accumulated;    ///< RGBA16F, or packed: radiance; values that are not finite do not count.
  LightingAlpha alpha;        ///< What the alpha channel of `accumulated` holds; pixels without samples do not count.
  fg::Texture lighting = {};  ///< The host's; needed if `accumulated` is packed, with `antilag`, and for
                              ///< `BlockRegressionSettings::share`, which has no effect on diffuse light without it.
  LightPattern pattern = {};  ///< Of `lighting`.
  std::optional<LightGrid> lightGrid = std::nullopt;     ///< If `accumulated` lies on it.
  std::optional<SteeredHistory> history = std::nullopt;  ///< Of `accumulated`, if `AccumulatedShareSettings` steers it.
  std::optional<CurrentAntilag> antilag = std::nullopt;  ///< Shortens the history in `accumulated` in this frame.
};

/// The fits of a frame, which the reconstruction reads (shaders/regression/stored_fit.h).
struct BlockFits {
  fg::Buffer fine;    ///< One `StoredBlockFit` per block, row by row.
  fg::Buffer coarse;  ///< One `StoredFit` per cell, row by row.
  fg::Texture depth;  ///< R32_UINT: depth of each block, and whether its fit has converged (block_storage.glsl).
};

/// Weighted linear regression of the lighting on {1, normal, inverse depth, ambient occlusion} over blocks of pixels:
/// fine fits from edge-aware a-trous averages, and coarse fits where fine ones have few samples. Offers the views of
/// every iteration.
/// @param frame  upload of `FrameConstants`
/// @param guides with `features`
/// @throws std::invalid_argument for settings that contradict each other (their ranges are the caller's to check,
/// `Configurable::checkSettings`), or if the fits of all blocks need a larger buffer than every device has
BlockFits addBlockRegression(StageGraph graph, fg::Buffer frame, const BlockLight& light, const Guides& guides,
                             const BlockRegressionSettings& settings = {});

/// Reconstruct every pixel from the fits around it and its own features.
/// @param frame    upload of `FrameConstants`
/// @param light    as given to `addBlockRegression`
/// @param target   texture to write to: RGBA16F, or packed, which holds no pass-through (packed_light.glsl)
/// @param settings of the regression
/// @returns the target's new version: filtered radiance; in RGBA16F the pass-through at sky and pixels without a
/// diffuse lobe
fg::Texture addBlockReconstruction(StageGraph graph, fg::Buffer frame, const BlockLight& light, const Guides& guides,
                                   const BlockFits& fits, fg::Texture target,
                                   const BlockRegressionSettings& settings = {});

}  // namespace walr
