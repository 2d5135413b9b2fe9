#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/block_regression.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/reflection_motion.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of `walr`.
struct WalrSettings {
  bool spatialOnly = false;
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation{.maxHistory = 8.0F,
                                            .thresholds = kStrictThresholds,
                                            .antilag = {.enabled = true},
                                            .storage = LightStorage::Packed};
  /// Of both temporal stages. A larger one hardly gains anything, because noise passes for a change of light before.
  float restFactor = 6.0F;
  /// Wide windows need less history, and a short one blurs less what moves on the surface.
  float maxSpecularHistory = 5.0F;
  AmbientOcclusionSettings occlusion;
  BlockRegressionSettings blocks;
  bool fitWindow = true;
  TemporalAntialiasingSettings antialiasing{
      .clipGamma = 5.0F, .thresholds = kStrictThresholds, .storage = LightStorage::Packed};
  float specularClipGamma = 2.0F;

  void visit(SettingVisitor& v) {
    v.visit({"spatial-only", "Filter each frame by itself, without the temporal stages", "", 0, 1,
             "Meunier & Harada 2022, 4.3"},
            spatialOnly);
    guides.visit(v);
    accumulation.visitAmounts(v, kDiffuseLight);
    v.visit({"accumulation.rest-factor",
             "With antilag, and for diffuse light blocks.residual: where the picture is at rest and the light does not "
             "change, accumulation may have so many times as long a history, and anti-aliasing once less",
             "", 1.0, 16.0, "measured"},
            restFactor);
    visitMaxSpecularHistory(v, maxSpecularHistory);
    accumulation.visitStorage(v);
    SettingsOfLight fits(v, kDiffuseLight);
    fits.visit(
        {"walr.fit-window",
         "Make blocks no larger than 1/43 of the image's height, but at least of 4 pixels; leave out iterations whose "
         "window would span far more than a tenth of the height; widen windows where a sample of light stands for "
         "several pixels",
         "", 0, 1, "measured"},
        fitWindow);
    occlusion.visit(fits);
    blocks.visit(fits);
    antialiasing.visitAmounts(v, kDiffuseLight);
    v.visit({"antialiasing.specular-clip-gamma", "`antialiasing.clip-gamma` of this light", "standard deviations", 0.0,
             1e6, "measured", kSpecularLight},
            specularClipGamma);
    antialiasing.visitStorage(v);
  }
};

/// The project's own method: Weighted A-Trous Linear Regression (Meunier & Harada 2022, figure 6) over blocks of
/// pixels instead of pixels, which leaves room for depth and occlusion as features. See passes/WALR.md. Specular light
/// is filtered by means over lobes instead: passes/SPECULAR.md.
/// @param output     RGBA16F texture to write the result to
/// @returns the output's new version
/// @throws std::invalid_argument for settings that contradict each other; their ranges are the caller's to check
/// (`Configurable::checkSettings`)
fg::Texture addWalr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                    const WalrSettings& settings = {});

}  // namespace walr
