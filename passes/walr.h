#pragma once

#include "framegraph/declare/graph.h"
#include "passes/block_regression.h"
#include "passes/inputs.h"
#include "passes/prepare_guides.h"
#include "passes/temporal_accumulation.h"
#include "passes/temporal_antialiasing.h"
#include "passes/weighted_regression.h"

namespace walr {

/// What the spatial filter regresses over.
enum class SpatialFilter : std::uint32_t {
  Pixels,  ///< Moments of every pixel, as published.
  Blocks,  ///< Moments of blocks of pixels, more features, a coarse fit where samples are few.
};

/// Settings of all stages of WALR.
struct WalrSettings {
  bool spatialOnly = false;
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation{
      .maxSamples = 8.0F, .change = {.respond = true}, .storage = LightStorage::Packed};
  WeightedRegressionSettings regression;
  TemporalAntialiasingSettings antialiasing{.clipGamma = 5.0F, .storage = LightStorage::Packed};
  SpatialFilter filter = SpatialFilter::Blocks;
  AmbientOcclusionSettings occlusion;
  BlockRegressionSettings blocks;
  bool fitWindow = true;

  void visit(SettingVisitor& v) {
    v.visit({"spatial-only", "Filter each frame by itself, without the temporal stages", "", 0, 1,
             "Meunier & Harada 2022, 4.3"},
            spatialOnly);
    guides.visit(v);
    accumulation.visit(v);
    accumulation.visitStorage(v);
    static constexpr std::string_view kFilters[] = {"pixels", "blocks"};
    v.visitEnum({"walr.filter",
                 "Regress over pixels with the settings regression.*, or over blocks with occlusion.* and blocks.*", "",
                 0, 1, "measured"},
                kFilters, filter);
    v.visit(
        {"walr.fit-window",
         "Leave out the last iterations where their window would span far more than a tenth of the image's height, and "
         "make blocks no larger than 1/43 of it but 4 pixels",
         "", 0, 1, "measured"},
        fitWindow);
    regression.visit(v);
    occlusion.visit(v);
    blocks.visit(v);
    antialiasing.visit(v);
    antialiasing.visitStorage(v);
  }
};

/// The defaults: moments of blocks instead of pixels, which leave room for features that know depth and occlusion.
WalrSettings blocksWalr();

/// The paper's shape and bandwidth with what measurements condemn mended.
WalrSettings robustWalr();

/// Faithful to the publication: raw half-precision moments without sample counts, floored pivots, the shading normal's
/// plane, bicubic history, dilated motion, depth rejection, variance clipping alone after the filter, every
/// surface taken for a diffuse one.
WalrSettings paperWalr();

/// Weighted A-Trous Linear Regression (Meunier & Harada 2022, figure 6): preprocessing, spatial filtering,
/// postprocessing.
/// @param output RGBA16F texture to write the result to
/// @param inspection is offered the views of all stages
/// @returns the output's new version
/// @throws std::invalid_argument for settings outside their range
fg::Texture addWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                    const WalrSettings& settings = {}, Inspection* inspection = nullptr);

}  // namespace walr
