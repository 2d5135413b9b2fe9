#include "passes/methods/bmfr.h"

#include "passes/temporal/temporal_stages.h"

namespace walr {

BmfrSettings tunedBmfr() {
  return {};
}

BmfrSettings paperBmfr() {
  BmfrSettings settings;
  settings.fittedAccumulation.maxHistory = 10.0F;
  return settings;
}

fg::Texture addBmfr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const BmfrSettings& settings) {
  const TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                        .antialiasing = settings.antialiasing,
                                                        .spatialOnly = settings.spatialOnly,
                                                        .keepTaps = true});
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, plan.guides);
  const Accumulated accumulated = addAccumulation(graph, inputs, guides, plan);
  const fg::Texture fitTarget = plan.accumulates ? graph->texture("fit", graph->textureDesc(output)) : output;
  fg::Texture fitted =
      addBmfrFit(graph, inputs.frame, accumulated.lighting, accumulated.alpha, guides, fitTarget, settings.fit);
  if (plan.accumulates) {
    fitted = addBmfrAccumulation(graph, inputs.frame, fitted, accumulated.taps, settings.fittedAccumulation);
  }
  return addAntialiasing(graph, inputs, guides, plan, accumulated, fitted, output);
}

}  // namespace walr
