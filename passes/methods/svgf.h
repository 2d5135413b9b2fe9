#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/filters/svgf_filter.h"
#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/reflection_motion.h"
#include "passes/temporal/svgf_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of SVGF.
struct SvgfSettings {
  bool spatialOnly = false;
  PrepareGuidesSettings guides;
  SvgfAccumulationSettings accumulation;
  SvgfFilterSettings filter;
  ReflectionMotionSettings reflection;
  TemporalAntialiasingSettings antialiasing;

  void visit(SettingVisitor& v) {
    v.visit({"spatial-only", "Filter each frame by itself, without temporal stages", "", 0, 1, "Fu 2022"}, spatialOnly);
    guides.visit(v);
    accumulation.visit(v);
    filter.visit(v);
    reflection.visit(v);
    antialiasing.visit(v);
  }
};

/// The defaults, tuned for 1 sample per pixel. The history is the accumulated light itself, because feeding back
/// filtered light would blur gradients; the lower exponent of the normal suits normal maps.
SvgfSettings tunedSvgf();
/// As published (Schied et al. 2017, 4.2 to 4.4; figure 1); specular light, too, but for its motion.
SvgfSettings paperSvgf();

/// Spatiotemporal Variance-Guided Filtering (Schied et al. 2017, figure 1; Fu 2022): temporal accumulation, estimation
/// of the variance, a-trous iterations guided by it, temporal anti-aliasing. The history of light is the result of the
/// iteration `svgf.feedback`, or the accumulated light if that is 0. Specular light moves with what is reflected
/// (`ReflectionMotion`), and lobes weigh it in place of normals.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addSvgf(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                    const SvgfSettings& settings = {});

}  // namespace walr
