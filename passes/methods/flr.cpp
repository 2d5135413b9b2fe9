#include "passes/methods/flr.h"

#include "passes/temporal/temporal_stages.h"

namespace walr {
namespace {

/// @param network null: there are no learned guides
fg::Texture addStages(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const FlrSettings& settings,
                      const GuideNetwork* network) {
  const TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                        .antialiasing = settings.antialiasing,
                                                        .spatialOnly = settings.spatialOnly});
  GuideNeeds needs = plan.guides;
  if (settings.regression.occlusionGuide) needs.occlusion = settings.occlusion;
  FlrRegressionSettings regression = settings.regression;
  if (settings.spatialOnly) regression.sigma = settings.singleFrameSigma;

  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, needs);
  const Accumulated accumulated = addAccumulation(graph, inputs, guides, plan);
  LearnedGuides learned;
  if (network != nullptr) learned = addGuideNetwork(graph, accumulated.lighting, accumulated.alpha, guides, *network);
  const fg::Texture filtered = addFlrRegression(graph, accumulated.lighting, accumulated.alpha, guides,
                                                filterTarget(graph, plan, output), regression, learned);
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

}  // namespace

fg::Texture addFlr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const FlrSettings& settings) {
  return addStages(graph, inputs, output, settings, nullptr);
}

fg::Texture addFlrWithNetwork(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                              const FlrSettings& settings, const GuideNetwork& network) {
  return addStages(graph, inputs, output, settings, &network);
}

}  // namespace walr
