#pragma once

#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"
#include "shaders/guides/prepare_guides.h"

/// The parts of a pass that prepares guides (guides.glsl), alone or before other work on the same pixels.
namespace walr {

/// Offer the views of the G-buffer's conversion.
void offerGuideViews(StageGraph graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings);

/// The constants of host_surface.glsl and guides.glsl.
PrepareGuidesConstants guideConstants(const fg::Graph& graph, const DenoiserInputs& inputs,
                                      const PrepareGuidesSettings& settings, const GuideNeeds& needs);

/// Declare what host_surface.glsl reads, and specialize its shader. The pass itself declares `frameConstants`.
void readGBuffer(fg::PassBuilder& pass, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings);

/// Whether the geometric normal has a texture of its own: it is needed, and depth does not hold it.
bool geometricNormalIsApart(const GuideNeeds& needs);

/// Declare what guides.glsl writes, and specialize what decides which guides these are.
Guides writeGuides(StageGraph graph, fg::PassBuilder& pass, fg::Extent extent, const GuideNeeds& needs);

}  // namespace walr
