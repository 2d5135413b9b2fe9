#pragma once

#include <functional>
#include <string>

#include "framegraph/declare/graph.h"
#include "passes/inputs.h"
#include "passes/light_storage.h"
#include "passes/lighting_alpha.h"
#include "passes/prepare_guides.h"
#include "passes/temporal_accumulation.h"
#include "passes/temporal_antialiasing.h"

namespace walr {

/// What a spatial filter works on.
struct FilterInput {
  fg::Texture lighting = {};  ///< The frame's lighting, or its temporal mean as `accumulation.storage` says.
  LightingAlpha alpha = LightingAlpha::Unused;
  LightStorage result = LightStorage::Half;  ///< What the result is to be in.
  fg::Texture taps = {};    ///< `AccumulationWithTaps::taps`, where `TemporalStages::keepTaps` asks for them.
  fg::Texture output = {};  ///< Where the result had best go; invalid where another stage reads it.

  /// The output, or a new RGBA16F texture where there is none.
  [[nodiscard]] fg::Texture target(fg::Graph& graph, std::string name) const;
};

/// Adds the spatial filter's passes and returns their result.
using AddFilter = std::function<fg::Texture(const FilterInput& input)>;

/// The temporal stages around a spatial filter (Meunier & Harada 2022, figure 6).
struct TemporalStages {
  TemporalAccumulationSettings accumulation;
  TemporalAntialiasingSettings antialiasing;
  bool spatialOnly = false;  ///< Filter each frame by itself, without the temporal stages.
  bool keepTaps = false;     ///< The filter has a history of its own; anti-aliasing's storage is then half.
};

/// The guides that these stages read, beside those of the filter.
/// @param filterNeedsGeometricNormal whether the filter reads the geometric normal
GuideNeeds guideNeeds(const TemporalStages& stages, const SceneDescription& scene, bool filterNeedsGeometricNormal);

/// Add accumulation, filter and anti-aliasing, as far as settings and scene ask for them. Anti-aliasing reads the
/// reprojection that accumulation has kept, where both look for their histories in the same way.
/// @param output     RGBA16F texture to write the result to
/// @param inspection is offered the views of the temporal stages
/// @returns the output's new version
fg::Texture addTemporalStages(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides, fg::Texture output,
                              const TemporalStages& stages, const AddFilter& filter, Inspection* inspection = nullptr);

}  // namespace walr
