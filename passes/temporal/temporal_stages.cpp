#include "passes/temporal/temporal_stages.h"

#include <stdexcept>

#include "passes/guides/shared_guides.h"
#include "passes/stage/pass_through.h"

namespace walr {
namespace {

/// Guides for the tests of history taps.
GuideNeeds guidesOf(const TemporalPlan& plan, bool specular) {
  const auto uses = [&](HistoryRejection rejection) {
    return plan.accumulation.rejection == rejection || (plan.antialiases && plan.antialiasing.rejection == rejection);
  };
  const bool byPlane = uses(HistoryRejection::Plane);
  // The motion of specular light is tested by its shading normals.
  return {.geometricNormal = byPlane && !specular, .history = byPlane || uses(HistoryRejection::Depth)};
}

/// Storage of the anti-aliasing that reads the kept taps.
LightStorage tapsReader(const TemporalPlan& plan) {
  return plan.sharesTaps ? plan.antialiasing.storage : LightStorage::Half;
}

Accumulated accumulatedLight(const AccumulatedLight& light) {
  return {.lighting = light.mean, .alpha = LightingAlpha::SampleCount, .antilag = light.antilag};
}

Accumulated withTaps(const AccumulationWithTaps& accumulated) {
  Accumulated result = accumulatedLight(accumulated.light);
  result.taps = accumulated.taps;
  return result;
}

}  // namespace

void requireSpatialLight(const DenoiserInputs& inputs) {
  if (inputs.conventions.specular) {
    throw std::invalid_argument("setting spatial-only is for diffuse light: specular light is accumulated first");
  }
  if (!inputs.conventions.light.everyPixel()) {
    throw std::invalid_argument(
        "setting spatial-only needs a sample of light at every pixel: sparse light is accumulated first");
  }
}

TemporalPlan planTemporalStages(const DenoiserInputs& inputs, const TemporalStages& stages) {
  if (stages.spatialOnly) requireSpatialLight(inputs);
  TemporalPlan plan{.accumulation = stages.accumulation,
                    .antialiasing = stages.antialiasing,
                    .accumulates = !stages.spatialOnly,
                    .antialiases = !stages.spatialOnly && stages.antialiasing.enabled && !inputs.scene.hostAntialiasing,
                    .guides = {.geometricNormal = false, .history = false}};
  plan.antialiasing.objectIds = stages.antialiasing.objectIds && inputs.objectId.valid();
  if (plan.antialiases) plan.filtered = plan.antialiasing.storage;
  const bool reprojects = plan.accumulates && (!inputs.scene.still() || stages.keepTaps);
  if (!reprojects) return plan;
  const bool givenMotion = inputs.conventions.specular;
  if (givenMotion && plan.antialiases) requireGivenTaps(stages.antialiasing);
  plan.sharesTaps = plan.antialiases && (givenMotion || sharesReprojection(plan.antialiasing, plan.accumulation));
  plan.keepsTaps = plan.sharesTaps || stages.keepTaps;
  plan.guides = guidesOf(plan, givenMotion);
  return plan;
}

Accumulated addAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan) {
  if (!plan.accumulates) return {.lighting = inputs.lighting};
  if (!plan.keepsTaps) {
    return accumulatedLight(addTemporalAccumulation(graph, inputs, guides, plan.accumulation, plan.steering));
  }
  return withTaps(
      addTemporalAccumulationWithTaps(graph, inputs, guides, plan.accumulation, tapsReader(plan), plan.steering));
}

Accumulated addAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan, const ReflectionMotion& motion) {
  DenoiserInputs followed = inputs;
  followed.confidence = motion.confidence;
  return withTaps(addTemporalAccumulationWithTaps(graph, followed, guides, plan.accumulation, tapsReader(plan),
                                                  plan.steering, motion.taps));
}

GuidedInput addGuidesWithAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                      const PrepareGuidesSettings& settings, const GuideNeeds& needs,
                                      const TemporalPlan& plan) {
  const bool allGuides = needs.geometricNormal && needs.history && needs.occlusion.has_value();
  const bool haveGuides = graph.shared() != nullptr && graph.shared()->prepared();
  if (!haveGuides && plan.accumulates && plan.keepsTaps && allGuides && canJoinGuides(plan.accumulation)) {
    const auto [guides, withGuides, lightGrid] =
        addGuidesAndAccumulation(graph, inputs, settings, needs, plan.accumulation, tapsReader(plan), plan.steering);
    Accumulated accumulated = withTaps(withGuides);
    accumulated.lightGrid = lightGrid;
    return {guides, accumulated};
  }
  const Guides guides = addPrepareGuides(graph, inputs, settings, needs);
  return {guides, addAccumulation(graph, inputs, guides, plan)};
}

ReflectedInput addReflectionsWithAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                              const PrepareGuidesSettings& settings, const TemporalPlan& plan) {
  if (graph.shared() == nullptr && canJoinGuides(plan.accumulation)) {
    const auto [guides, reflectors, accumulated] =
        addReflectionsAndAccumulation(graph, inputs, settings, plan.accumulation, tapsReader(plan));
    return {guides, reflectors, withTaps(accumulated)};
  }
  const Guides guides = addPrepareGuides(graph, inputs, settings, {.geometricNormal = false});
  const ReflectionMotion motion = addReflectionMotion(graph, inputs, guides, plan.accumulation, {}, true);
  return {guides, motion.reflectors, addAccumulation(graph, inputs, guides, plan, motion)};
}

fg::Texture filterTarget(StageGraph graph, const TemporalPlan& plan, fg::Texture output) {
  if (!plan.antialiases) return output;
  return graph.texture("filtered", {formatOf(plan.filtered), graph.textureDesc(output).extent});
}

fg::Texture addAntialiasing(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                            const TemporalPlan& plan, const Accumulated& accumulated, fg::Texture filtered,
                            fg::Texture output) {
  if (!plan.antialiases) {
    return filtered.resource == output.resource ? filtered : addPassThrough(graph, filtered, output);
  }
  if (!plan.sharesTaps) {
    return addTemporalAntialiasing(graph, inputs, guides, filtered, output, plan.antialiasing,
                                   accumulated.antilag.shortening);
  }
  const fg::Texture depth = coversPixelArea(plan.antialiasing, inputs.scene) ? guides.depth : fg::Texture{};
  return addTemporalAntialiasingWithTaps(graph, inputs.frame, accumulated.taps, depth, filtered, output,
                                         plan.antialiasing, accumulated.antilag.shortening);
}

}  // namespace walr
