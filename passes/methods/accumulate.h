#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/reflection_motion.h"
#include "passes/temporal/temporal_accumulation.h"

namespace walr {

/// Settings of temporal accumulation alone.
struct AccumulateSettings {
  PrepareGuidesSettings guides;
  TemporalAccumulationSettings accumulation;
  ReflectionMotionSettings reflection;

  void visit(SettingVisitor& v) {
    guides.visit(v);
    accumulation.visit(v);
    reflection.visit(v);
  }
};

/// Temporal accumulation alone: what every spatial filter is measured against. Specular light is accumulated along its
/// own motion (`ReflectionMotion`).
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addAccumulate(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                          const AccumulateSettings& settings = {});

}  // namespace walr
