#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/prepare_guides.h"
#include "passes/network/guide_network.h"
#include "passes/regression/flr_regression.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of FLR.
struct FlrSettings {
  static constexpr HistoryThresholds kThresholds{.planeTolerance = kStrictThresholds.planeTolerance,
                                                 .normalThreshold = 0.8F};

  bool spatialOnly = false;
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation{.maxHistory = 8.0F, .thresholds = kThresholds};
  AmbientOcclusionSettings occlusion;
  FlrRegressionSettings regression;
  float singleFrameSigma = 12.0F;
  TemporalAntialiasingSettings antialiasing{.thresholds = kThresholds};

  void visit(SettingVisitor& v) {
    visitBefore(v);
    regression.visit(v);
    visitAfter(v);
  }
  /// Settings of the stages up to the regression.
  void visitBefore(SettingVisitor& v) {
    v.visit({"spatial-only", "Filter each frame on its own, as published, without the temporal stages", "", 0, 1,
             "Salmi et al. 2024"},
            spatialOnly);
    guides.visit(v);
    accumulation.visit(v);
    occlusion.visit(v);
  }
  /// Settings of the window of single frames, and of the stages after the regression.
  void visitAfter(SettingVisitor& v) {
    v.visit({"regression.single-frame-sigma",
             "Standard deviation of the Gaussian window with spatial-only, in place of regression.sigma", "pixels", 0.1,
             256.0, "measured"},
            singleFrameSigma);
    antialiasing.visit(v);
  }
};

/// Fast Local Regression (Salmi et al. 2024), between temporal accumulation and temporal anti-aliasing.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addFlr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                   const FlrSettings& settings = {});

/// The same with more guides.
/// @param settings with the occlusion guide
/// @param network  makes the guides from the geometric ones and the light
fg::Texture addFlrWithNetwork(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                              const FlrSettings& settings, const GuideNetwork& network);

}  // namespace walr
