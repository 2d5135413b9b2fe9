#include "passes/flr.h"

#include "passes/temporal_stages.h"

namespace walr {

fg::Texture addFlr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const FlrSettings& settings) {
  const TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                        .antialiasing = settings.antialiasing,
                                                        .spatialOnly = settings.spatialOnly});
  GuideNeeds needs = plan.guides;
  if (settings.regression.occlusionGuide) needs.occlusion = settings.occlusion;
  FlrRegressionSettings regression = settings.regression;
  if (settings.spatialOnly) regression.sigma = settings.singleFrameSigma;

  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, needs);
  const Accumulated accumulated = addAccumulation(graph, inputs, guides, plan);
  const fg::Texture filtered = addFlrRegression(graph, accumulated.lighting, accumulated.alpha, guides,
                                                filterTarget(graph, plan, output), regression);
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

}  // namespace walr
