#include "passes/temporal_stages.h"

#include <utility>

#include "passes/pass_through.h"

namespace walr {

GuideNeeds guideNeeds(const TemporalStages& stages, const SceneDescription& scene, bool filterNeedsGeometricNormal) {
  const bool reprojects = !stages.spatialOnly && (!scene.still() || stages.keepTaps);
  if (!reprojects) return {.geometricNormal = filterNeedsGeometricNormal, .history = false};
  const bool antialias = stages.antialiasing.enabled && !scene.hostAntialiasing;
  const auto uses = [&](HistoryRejection rejection) {
    return stages.accumulation.rejection == rejection || (antialias && stages.antialiasing.rejection == rejection);
  };
  const bool byPlane = uses(HistoryRejection::Plane);
  return {.geometricNormal = filterNeedsGeometricNormal || byPlane,
          .history = byPlane || uses(HistoryRejection::Depth)};
}

fg::Texture FilterInput::target(fg::Graph& graph, std::string name) const {
  if (output.valid()) return output;
  return graph.texture(std::move(name), {VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(lighting).extent});
}

fg::Texture addTemporalStages(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides, fg::Texture output,
                              const TemporalStages& stages, const AddFilter& filter, Inspection* inspection) {
  const auto filterToOutput = [&](FilterInput input) {
    input.output = output;
    const fg::Texture result = filter(input);
    return result.resource == output.resource ? result : addPassThrough(graph, result, output);
  };
  if (stages.spatialOnly) return filterToOutput({.lighting = inputs.lighting});

  const bool antialias = stages.antialiasing.enabled && !inputs.scene.hostAntialiasing;
  const bool reprojects = !inputs.scene.still() || stages.keepTaps;
  TemporalAntialiasingSettings antialiasing = stages.antialiasing;
  antialiasing.objectIds = antialiasing.objectIds && inputs.objectId.valid();
  const bool share = antialias && reprojects && sharesReprojection(antialiasing, stages.accumulation);
  FilterInput input{.alpha = LightingAlpha::SampleCount};
  if (share || stages.keepTaps) {
    const auto [mean, taps] = addTemporalAccumulationWithTaps(
        graph, inputs, guides, stages.accumulation, share ? antialiasing.storage : LightStorage::Half, inspection);
    input.lighting = mean;
    input.taps = taps;
  } else {
    input.lighting = addTemporalAccumulation(graph, inputs, guides, stages.accumulation, inspection);
  }
  if (!antialias) return filterToOutput(input);
  input.result = antialiasing.storage;
  const fg::Texture filtered = filter(input);
  return share ? addTemporalAntialiasingWithTaps(graph, inputs.frame, input.taps, filtered, output, antialiasing,
                                                 inspection)
               : addTemporalAntialiasing(graph, inputs, guides, filtered, output, antialiasing, inspection);
}

}  // namespace walr
