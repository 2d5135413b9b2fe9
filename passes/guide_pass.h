#pragma once

#include "passes/prepare_guides.h"
#include "passes/stage_graph.h"
#include "shaders/constants/prepare_guides.h"

/// The parts of a pass that prepares guides (guides.glsl), alone or before other work on the same pixels.
namespace walr {

/// Offer the views of the G-buffer's conversion.
void offerGuideViews(StageGraph graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings);

/// The constants of guides.glsl.
PrepareGuidesConstants guideConstants(const fg::Graph& graph, const DenoiserInputs& inputs,
                                      const PrepareGuidesSettings& settings, const GuideNeeds& needs);

/// Declare what guides.glsl reads, and specialize its shader. The pass itself declares `frameConstants`.
void readGBuffer(fg::PassBuilder& pass, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings);

/// Declare what store_guides.glsl writes, and specialize what only guides need that are written.
Guides writeGuides(StageGraph graph, fg::PassBuilder& pass, fg::Extent extent, const GuideNeeds& needs);

}  // namespace walr
