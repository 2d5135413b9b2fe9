#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/reflection_motion.h"

namespace walr {

/// Settings of SVGF's temporal filtering.
struct SvgfAccumulationSettings {
  float maxHistory = 8.0F;
  float maxMomentHistory = 5.0F;
  float maxSpecularHistory = 4.0F;
  HistoryThresholds thresholds{.planeTolerance = kStrictThresholds.planeTolerance};

  void visit(SettingVisitor& v) {
    v.visit({"accumulation.max-history", "Frames after which the mean colour turns exponential", "frames", 1.0, 255.0,
             "measured; the paper's alpha of 0.2 is 5", kDiffuseLight},
            maxHistory);
    v.visit({"accumulation.max-moment-history", "Frames after which the luminance moments turn exponential", "frames",
             1.0, 255.0, "Schied et al. 2017, 4.2: alpha 0.2"},
            maxMomentHistory);
    visitMaxSpecularHistory(v, maxSpecularHistory);
    visitThresholds(v, "accumulation.plane-tolerance", "accumulation.normal-threshold", thresholds);
  }
};

/// The result of SVGF's temporal accumulation.
struct SvgfAccumulated {
  fg::Texture colour;  ///< RGBA16F: mean radiance; sky and pixels without a diffuse lobe hold the pass-through.
  /// RGBA16F: mean of the luminance, its standard deviation, history length (0: none), and of specular light the view
  /// depth over the mean distance of what is reflected.
  fg::Texture moments;
  fg::Texture lobes = {};  ///< Of specular light only. R32G32_UINT: see shaders/conventions/packed_lobe.glsl.
};

/// Average colour and luminance moments over time along the motion.
/// @param previousColour RGBA16F: the colour's history
/// @param colour         RGBA16F texture to write the mean colour to
/// @param reflection     of specular light, which it makes follow; the inputs' confidence is then not read
SvgfAccumulated addSvgfAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture previousColour, fg::Texture colour,
                                    const SvgfAccumulationSettings& settings = {},
                                    const ReflectionMotion& reflection = {});

}  // namespace walr
