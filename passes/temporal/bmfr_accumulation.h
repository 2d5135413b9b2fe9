#pragma once

#include "framegraph/declare/graph.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"

namespace walr {

/// Settings of BMFR's second accumulation (Koskela et al. 2019, 3.5).
struct BmfrAccumulationSettings {
  float maxHistory = 5.0F;

  void visit(SettingVisitor& v) {
    v.visit({"fitted.max-history", "Fitted frames after which the cumulative mean turns exponential", "frames", 1.0,
             255.0, "Koskela et al. 2019, 3.5"},
            maxHistory);
  }
};

/// Average the fitted frames over time with the history taps that the first accumulation accepted.
/// @param frame  upload of `FrameConstants`
/// @param fitted RGBA16F: the current fit
/// @param taps   R32_UINT: `AccumulationWithTaps::taps`
/// @returns RGBA16F: mean; alpha: history length, 0 where there is nothing to denoise
fg::Texture addBmfrAccumulation(StageGraph graph, fg::Buffer frame, fg::Texture fitted, fg::Texture taps,
                                const BmfrAccumulationSettings& settings = {});

}  // namespace walr
