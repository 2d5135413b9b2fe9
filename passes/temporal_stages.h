#pragma once

#include "framegraph/declare/graph.h"
#include "passes/inputs.h"
#include "passes/light_storage.h"
#include "passes/lighting_alpha.h"
#include "passes/prepare_guides.h"
#include "passes/stage_graph.h"
#include "passes/temporal_accumulation.h"
#include "passes/temporal_antialiasing.h"

/// The temporal stages around a method's spatial filter (Meunier & Harada 2022, figure 6): accumulation before it,
/// anti-aliasing after it. Both look for their histories along the same motion, so that a method plans them together,
/// then adds one, its filter and the other.
namespace walr {

/// What a method asks of its temporal stages.
struct TemporalStages {
  TemporalAccumulationSettings accumulation;
  TemporalAntialiasingSettings antialiasing;
  bool spatialOnly = false;  ///< Filter each frame by itself, without the temporal stages.
  bool keepTaps = false;     ///< The filter has a history of its own, which it reads with `Accumulated::taps`.
};

/// The temporal stages as far as settings and scene ask for them.
struct TemporalPlan {
  TemporalAccumulationSettings accumulation;
  TemporalAntialiasingSettings antialiasing;
  bool accumulates = true;                     ///< Else the filter works on the frame's lighting.
  bool antialiases = true;                     ///< Else the filter's result is the method's.
  bool keepsTaps = false;                      ///< Accumulation keeps what its reprojection found, for later stages.
  bool sharesTaps = false;                     ///< Anti-aliasing reads that in place of a reprojection of its own.
  GuideNeeds guides;                           ///< Guides that these stages read. A filter may need more.
  LightStorage filtered = LightStorage::Half;  ///< Storage of the filter's result.
};

/// Decide what the temporal stages do. Anti-aliasing reads the reprojection of accumulation where both look for their
/// histories in the same way; then, and where a filter has a history of its own, accumulation keeps it.
TemporalPlan planTemporalStages(const DenoiserInputs& inputs, const TemporalStages& stages);

/// What a spatial filter works on.
struct Accumulated {
  fg::Texture lighting;  ///< The temporal mean as `accumulation.storage` says, or the frame's lighting.
  LightingAlpha alpha = LightingAlpha::Unused;
  fg::Texture taps = {};  ///< `AccumulationWithTaps::taps`, where the plan keeps them.
};

/// Add temporal accumulation, if the plan has it.
Accumulated addAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan);

/// The RGBA16F texture that a filter had best write to: the method's output where no stage follows, else a new one.
fg::Texture filterTarget(fg::Graph& graph, const TemporalPlan& plan, fg::Texture output);

/// Add temporal anti-aliasing, if the plan has it. Else copy what is not in the output yet.
/// @param filtered   the filter's result as `plan.filtered` says
/// @param output     RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addAntialiasing(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan, const Accumulated& accumulated, fg::Texture filtered,
                            fg::Texture output);

}  // namespace walr
