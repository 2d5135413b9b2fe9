#include "passes/methods/accumulate.h"

#include "passes/stage/pass_through.h"
#include "passes/temporal/temporal_stages.h"

namespace walr {
fg::Texture addAccumulate(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                          const AccumulateSettings& settings) {
  const TemporalPlan plan =
      planTemporalStages(inputs, {.accumulation = settings.accumulation, .antialiasing = {.enabled = false}});
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, plan.guides);
  const bool reflects = inputs.conventions.specular && !inputs.scene.still();
  const Accumulated accumulated =
      reflects ? addAccumulation(graph, inputs, guides, plan,
                                 addReflectionMotion(graph, inputs, guides, settings.accumulation, settings.reflection))
               : addAccumulation(graph, inputs, guides, plan);
  return addPassThrough(graph, accumulated.lighting, output);
}

}  // namespace walr
