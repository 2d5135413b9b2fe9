#include "passes/methods/accumulate.h"

#include "passes/stage/pass_through.h"
#include "passes/temporal/temporal_stages.h"

namespace walr {
namespace {

fg::Texture accumulateSpecular(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                               const AccumulateSettings& settings) {
  const ReflectionMotion motion =
      addReflectionMotion(graph, inputs, guides, settings.accumulation, settings.reflection);
  DenoiserInputs followed = inputs;
  followed.confidence = motion.confidence;
  return addTemporalAccumulationWithTaps(graph, followed, guides, settings.accumulation, LightStorage::Half, {},
                                         motion.taps)
      .light.mean;
}

}  // namespace

fg::Texture addAccumulate(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                          const AccumulateSettings& settings) {
  const TemporalPlan plan =
      planTemporalStages(inputs, {.accumulation = settings.accumulation, .antialiasing = {.enabled = false}});
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, plan.guides);
  const bool reflects = inputs.conventions.specular && !inputs.scene.still();
  const fg::Texture mean = reflects ? accumulateSpecular(graph, inputs, guides, settings)
                                    : addAccumulation(graph, inputs, guides, plan).lighting;
  return addPassThrough(graph, mean, output);
}

}  // namespace walr
