#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/full_window_regression.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of REFWLR.
struct RefwlrSettings {
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation;
  FullWindowSettings regression;
  TemporalAntialiasingSettings antialiasing;
  bool fitWindow = true;

  void visit(SettingVisitor& v) {
    guides.visit(v);
    accumulation.visit(v);
    v.visit(
        {"refwlr.fit-window", "Take no larger a window than WALR would at the image's height", "", 0, 1, "measured"},
        fitWindow);
    regression.visit(v);
    antialiasing.visit(v);
  }
};

/// The reference for preset "robust" of `walr_paper`: the same stages and weights.
RefwlrSettings robustRefwlr();

/// The reference for its preset "paper".
RefwlrSettings paperRefwlr();

/// Reference Weighted Linear Regression (Meunier & Harada 2022, 6): WALR with a full window in place of a-trous
/// averages. It shows what these cost in quality. It takes seconds per frame.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addRefwlr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                      const RefwlrSettings& settings = {});

}  // namespace walr
