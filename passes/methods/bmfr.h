#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/bmfr_fit.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/bmfr_accumulation.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of BMFR.
struct BmfrSettings {
  bool spatialOnly = false;
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation{.maxHistory = 5.0F, .thresholds = kStrictThresholds};
  BmfrFitSettings fit;
  BmfrAccumulationSettings fittedAccumulation;
  TemporalAntialiasingSettings antialiasing{.thresholds = kStrictThresholds};

  void visit(SettingVisitor& v) {
    v.visit({"spatial-only", "Fit each frame on its own, without the temporal stages", "", 0, 1,
             "Koskela et al. 2019, 3.3"},
            spatialOnly);
    guides.visit(v);
    accumulation.visit(v);
    fit.visit(v);
    fittedAccumulation.visit(v);
    antialiasing.visit(v);
  }
};

/// The defaults. Fitted frames are averaged half as long as published, because anti-aliasing averages them, too.
BmfrSettings tunedBmfr();
/// As published: a new fitted frame has a weight of 10 % (Koskela et al. 2019, 3.5).
BmfrSettings paperBmfr();

/// Blockwise Multi-Order Feature Regression (Koskela et al. 2019, figure 2): accumulation, feature fitting, a second
/// accumulation and temporal anti-aliasing.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addBmfr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                    const BmfrSettings& settings = {});

}  // namespace walr
