#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"

namespace walr {

/// Settings of the search for the place of reflected light in the previous frame.
struct ReflectionMotionSettings {
  float surfaceFrom = 0.42F;
  float historyPerLobe = 0.25F;

  void visit(SettingVisitor& v) {
    v.visit(
        {"reflection.surface-from", "Linear roughness from which history moves with the surface alone; 0: everywhere",
         "", 0.0, 1.0, "measured", kSpecularLight},
        surfaceFrom);
    v.visit({"reflection.history-per-lobe",
             "Longest history where the reflected ray of the previous frame misses by the lobe's half angle; more "
             "where it misses by less",
             "frames", 0.0, 255.0, "measured", kSpecularLight},
            historyPerLobe);
  }
};

/// Visit the length of history of methods that keep another one for specular light than for diffuse light.
inline void visitMaxSpecularHistory(SettingVisitor& v, float& maxHistory) {
  v.visit({"accumulation.max-specular-history", "`accumulation.max-history` of this light", "frames", 1.0, 255.0,
           "measured", kSpecularLight},
          maxHistory);
}

/// Where the specular light of every pixel was in the previous frame.
struct ReflectionMotion {
  fg::Texture taps;        ///< R32_UINT: as `AccumulationWithTaps::taps`.
  fg::Texture confidence;  ///< R8_UNORM: as `DenoiserInputs::confidence`, which it includes.
  fg::Texture reflectors;  ///< R32G32_UINT: what tells of the light that a pixel reflects (reflector.glsl).
};

/// Find the motion of specular light (passes/SPECULAR.md): to the place where the surface of the previous frame
/// reflected what is reflected now, or on rough surfaces to that of the surface.
/// @param guides   with the shading normal and with the history of depth
/// @param settings of the accumulation that takes the result
/// @param distances whether reflectors of all pixels have mean distances, else only those of mirrors
/// @throws std::invalid_argument if these settings do not test history by plane, or if objects move and the depth of
///         their motion is not given
ReflectionMotion addReflectionMotion(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                     const TemporalAccumulationSettings& settings,
                                     const ReflectionMotionSettings& reflection = {}, bool distances = false);

}  // namespace walr
