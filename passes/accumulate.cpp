#include "passes/accumulate.h"

#include "passes/pass_through.h"
#include "passes/temporal_stages.h"

namespace walr {

fg::Texture addAccumulate(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                          const AccumulateSettings& settings, Inspection* inspection) {
  const TemporalStages stages{.accumulation = settings.accumulation, .antialiasing = {.enabled = false}};
  const Guides guides =
      addPrepareGuides(graph, inputs, settings.guides, guideNeeds(stages, inputs.scene, false), inspection);
  return addPassThrough(graph, addTemporalAccumulation(graph, inputs, guides, settings.accumulation, inspection),
                        output);
}

}  // namespace walr
