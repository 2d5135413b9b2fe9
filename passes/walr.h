#pragma once

#include "framegraph/graph.h"
#include "passes/inputs.h"
#include "passes/prepare_guides.h"
#include "passes/temporal_accumulation.h"
#include "passes/temporal_antialiasing.h"
#include "passes/weighted_regression.h"

namespace walr {

/// Settings of all stages of WALR.
struct WalrSettings {
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation;
  WeightedRegressionSettings regression;
  TemporalAntialiasingSettings antialiasing;
  bool fitWindow = true;

  void visit(SettingVisitor& v) {
    guides.visit(v);
    accumulation.visit(v);
    v.visit({"walr.fit-window",
             "Leave out the last iterations where their window would span far more than a tenth of the image's height",
             "", 0, 1, "measured"},
            fitWindow);
    regression.visit(v);
    antialiasing.visit(v);
  }
};

/// The defaults: the paper's shape and bandwidth with what measurements condemn mended.
WalrSettings robustWalr();

/// Faithful to the publication: raw half-precision moments without sample counts, floored pivots, the shading normal's
/// plane, bicubic history, dilated motion, variance clipping alone after the filter.
WalrSettings paperWalr();

/// Weighted A-Trous Linear Regression (walr.txt, figure 6): preprocessing, spatial filtering, postprocessing.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                    const WalrSettings& settings = {});

}  // namespace walr
