#include "passes/accumulate.h"

#include "passes/pass_through.h"
#include "passes/temporal_stages.h"

namespace walr {

fg::Texture addAccumulate(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                          const AccumulateSettings& settings) {
  const Guides guides =
      addPrepareGuides(graph, inputs, settings.guides,
                       guideNeeds({.accumulation = settings.accumulation, .antialiasing = {.enabled = false}}, false));
  return addPassThrough(graph, addTemporalAccumulation(graph, inputs, guides, settings.accumulation), output);
}

}  // namespace walr
