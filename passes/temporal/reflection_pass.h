#pragma once

#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/reflection_motion.h"
#include "passes/temporal/reprojection.h"
#include "passes/temporal/temporal_accumulation.h"

/// The parts of a pass that finds the motion of reflections (reflection_motion.glsl), alone or before other work on the
/// same pixels.
namespace walr {

/// What the search for reflections works on.
struct ReflectionSearch {
  StageGraph graph;
  const DenoiserInputs& inputs;
  Guides guides;  ///< The history of depth, and without `host` depth and shading normal.
  const TemporalAccumulationSettings& settings;
  ReflectionMotionSettings reflection;
  fg::History reflectors;                     ///< `ReflectionMotion::reflectors`.
  std::optional<PrepareGuidesSettings> host;  ///< If set, surfaces come from the host's G-buffer (HOST_SURFACES).
};

/// Declare the history that the search needs, and offer its views.
/// @throws std::invalid_argument as `addReflectionMotion`
ReflectionSearch searchReflections(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                   const TemporalAccumulationSettings& settings,
                                   const ReflectionMotionSettings& reflection = {},
                                   const std::optional<PrepareGuidesSettings>& host = {});

/// The reprojection of surfaces, which the search begins with.
ReprojectionSettings reflectionReprojection(const DenoiserInputs& inputs, const TemporalAccumulationSettings& settings);

/// Declare what reflection_motion.glsl reads besides the lighting and what reprojection needs, and push its constants.
void readReflections(fg::PassBuilder& pass, const ReflectionSearch& search);

}  // namespace walr
