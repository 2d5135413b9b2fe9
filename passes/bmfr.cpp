#include "passes/bmfr.h"

#include "passes/temporal_stages.h"

namespace walr {

BmfrSettings tunedBmfr() {
  return {};
}

BmfrSettings paperBmfr() {
  BmfrSettings settings;
  settings.fittedAccumulation.maxSamples = 10.0F;
  return settings;
}

fg::Texture addBmfr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const BmfrSettings& settings,
                    Inspection* inspection) {
  const TemporalStages stages{.accumulation = settings.accumulation,
                              .antialiasing = settings.antialiasing,
                              .spatialOnly = settings.spatialOnly,
                              .keepTaps = true};
  const Guides guides =
      addPrepareGuides(graph, inputs, settings.guides, guideNeeds(stages, inputs.scene, false), inspection);
  const auto filter = [&](const FilterInput& input) {
    const fg::Texture target = settings.spatialOnly ? input.output : graph.texture("fit", graph.textureDesc(output));
    const fg::Texture fitted =
        addBmfrFit(graph, inputs.frame, input.lighting, input.alpha, guides, target, settings.fit, inspection);
    return settings.spatialOnly
               ? fitted
               : addBmfrAccumulation(graph, inputs.frame, fitted, input.taps, settings.fittedAccumulation);
  };
  return addTemporalStages(graph, inputs, guides, output, stages, filter, inspection);
}

}  // namespace walr
