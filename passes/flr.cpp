#include "passes/flr.h"

#include "passes/temporal_stages.h"

namespace walr {

fg::Texture addFlr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const FlrSettings& settings,
                   Inspection* inspection) {
  const TemporalStages stages{.accumulation = settings.accumulation,
                              .antialiasing = settings.antialiasing,
                              .spatialOnly = settings.spatialOnly};
  GuideNeeds needs = guideNeeds(stages, inputs.scene, false);
  if (settings.regression.occlusionGuide) needs.occlusion = settings.occlusion;
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, needs, inspection);
  FlrRegressionSettings regression = settings.regression;
  if (settings.spatialOnly) regression.sigma = settings.singleFrameSigma;
  const auto filter = [&](const FilterInput& input) {
    return addFlrRegression(graph, input.lighting, input.alpha, guides, input.target(graph, "filtered"), regression,
                            inspection);
  };
  return addTemporalStages(graph, inputs, guides, output, stages, filter, inspection);
}

}  // namespace walr
