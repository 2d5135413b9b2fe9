#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/weighted_regression.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of `walr_paper`. The defaults are faithful to the publication: raw half-precision moments
/// without sample counts, floored pivots, the shading normal's plane, bicubic history, dilated motion, depth rejection,
/// only variance clipping after the filter, every surface treated as diffuse.
struct WalrPaperSettings {
  bool spatialOnly = false;
  PrepareGuidesSettings guides{.albedoThreshold = 0.0F};
  TemporalAccumulationSettings accumulation{
      .rejection = HistoryRejection::Depth, .historyFilter = HistoryFilter::Bicubic, .dilateMotion = true};
  WeightedRegressionSettings regression{.edgeStopping = {.planeNormal = PlaneNormal::Shading, .normalFactor = false},
                                        .repeatCentre = true,
                                        .edgeLeak = 0.0F,
                                        .storage = MomentStorage::Raw16,
                                        .keepSampleCount = false,
                                        .regularisation = {.method = Regularisation::Floor, .ridge = 2e-3F}};
  bool fitWindow = false;
  TemporalAntialiasingSettings antialiasing{
      .maxHistory = 8.0F, .rejection = HistoryRejection::None, .dilateMotion = true, .pixelArea = false};

  void visit(SettingVisitor& v) {
    v.visit({"spatial-only", "Filter each frame by itself, without the temporal stages", "", 0, 1,
             "Meunier & Harada 2022, 4.3"},
            spatialOnly);
    guides.visit(v);
    accumulation.visit(v);
    v.visit({"walr_paper.fit-window",
             "Leave out the last iterations where their window would span far more than a tenth of the image's height",
             "", 0, 1, "measured"},
            fitWindow);
    regression.visit(v);
    antialiasing.visit(v);
  }
};

/// The defaults, as published.
WalrPaperSettings paperWalr();

/// The paper's method with those parts replaced that measurements showed to fail.
WalrPaperSettings robustWalr();

/// Weighted A-Trous Linear Regression as published, over pixels (Meunier & Harada 2022, figure 6).
/// @param output     RGBA16F texture to write the result to
/// @returns the output's new version
/// @throws std::invalid_argument for settings that contradict each other; their ranges are the caller's to check
/// (`Configurable::checkSettings`)
fg::Texture addWalrPaper(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                         const WalrPaperSettings& settings = {});

}  // namespace walr
