#include "passes/accumulate.h"

#include "passes/pass_through.h"

namespace walr {

fg::Texture addAccumulate(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                          const AccumulateSettings& settings) {
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  return addPassThrough(graph, addTemporalAccumulation(graph, inputs, guides, settings.accumulation), output);
}

}  // namespace walr
