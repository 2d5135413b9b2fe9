#pragma once

#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/conventions/light_storage.h"
#include "passes/conventions/lighting_alpha.h"
#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/reflection_motion.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"

/// The temporal stages around a method's spatial filter (Meunier & Harada 2022, figure 6): accumulation before it,
/// anti-aliasing after it. Both follow the same motion to their histories, so that a method plans them together,
/// then adds one, its filter and the other.
namespace walr {

/// The temporal stages that a method wants.
struct TemporalStages {
  TemporalAccumulationSettings accumulation;
  TemporalAntialiasingSettings antialiasing;
  bool spatialOnly = false;  ///< Filter each frame by itself, without the temporal stages.
  bool keepTaps = false;     ///< The filter reads a history of its own with `Accumulated::taps`.
};

/// The temporal stages that settings and scene need.
struct TemporalPlan {
  TemporalAccumulationSettings accumulation;
  TemporalAntialiasingSettings antialiasing;
  bool accumulates = true;                     ///< Else the filter works on the frame's lighting.
  bool antialiases = true;                     ///< Else the filter's result is the method's.
  bool keepsTaps = false;                      ///< Accumulation keeps its history taps for later stages.
  bool sharesTaps = false;                     ///< Anti-aliasing reads them instead of reprojecting.
  GuideNeeds guides;                           ///< Guides that these stages read. A filter may need more.
  LightStorage filtered = LightStorage::Half;  ///< Storage of the filter's result.
  fg::Texture steering = {};                   ///< `Antilag::steering`, which the filter measures, or invalid.
};

/// @throws std::invalid_argument saying why light must be accumulated before a frame can be filtered
void requireSpatialLight(const DenoiserInputs& inputs);

/// Decide what the temporal stages do. Accumulation keeps its history taps if anti-aliasing would find the same ones,
/// as it must for specular light, or if the filter reads a history of its own.
/// @throws std::invalid_argument if frames are filtered by themselves and not every pixel has a sample of light
TemporalPlan planTemporalStages(const DenoiserInputs& inputs, const TemporalStages& stages);

/// The input of a spatial filter.
struct Accumulated {
  fg::Texture lighting;  ///< The temporal mean in `accumulation.storage`, or the frame's lighting.
  LightingAlpha alpha = LightingAlpha::Unused;
  fg::Texture taps = {};                              ///< `AccumulationWithTaps::taps`, if the plan keeps them.
  std::optional<LightGrid> lightGrid = std::nullopt;  ///< If `lighting` lies on it.
  AntilagResult antilag = {};                         ///< `AccumulatedLight::antilag`.
};

/// Add temporal accumulation, if the plan has it.
Accumulated addAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan);
/// The same for specular light, along its own motion. The plan must accumulate.
Accumulated addAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan, const ReflectionMotion& motion);

/// The input of a spatial filter, and the guides beside it.
struct GuidedInput {
  Guides guides;
  Accumulated accumulated;
};

/// Add guides and temporal accumulation: as one pass where `canJoinGuides` says so, `needs` asks for all guides, and no
/// other light has made them (`SharedGuides`).
GuidedInput addGuidesWithAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                      const PrepareGuidesSettings& settings, const GuideNeeds& needs,
                                      const TemporalPlan& plan);

/// The input of a filter of specular light, and what it reads of its surfaces.
struct ReflectedInput {
  Guides guides;           ///< Depth and its history.
  fg::Texture reflectors;  ///< `ReflectionMotion::reflectors` with mean distances.
  Accumulated accumulated;
};

/// Add the motion of reflections and temporal accumulation along it: as one pass where `canJoinGuides` says so and no
/// other light shares the guides. The plan must accumulate.
/// @throws std::invalid_argument as `addReflectionMotion`
ReflectedInput addReflectionsWithAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                              const PrepareGuidesSettings& settings, const TemporalPlan& plan);

/// The texture for a filter to write to: the method's output if no stage follows, else a new one in the storage
/// `plan.filtered`.
fg::Texture filterTarget(StageGraph graph, const TemporalPlan& plan, fg::Texture output);

/// Add temporal anti-aliasing, if the plan has it. Otherwise copy the filter's result to the output, unless it is
/// there.
/// @param filtered   the filter's result, in the storage `plan.filtered`
/// @param output     RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addAntialiasing(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan, const Accumulated& accumulated, fg::Texture filtered,
                            fg::Texture output);

}  // namespace walr
