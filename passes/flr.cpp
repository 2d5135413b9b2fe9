#include "passes/flr.h"

#include "passes/temporal_stages.h"

namespace walr {

fg::Texture addFlr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const FlrSettings& settings,
                   Inspection* inspection) {
  const TemporalStages stages{.accumulation = settings.accumulation,
                              .antialiasing = settings.antialiasing,
                              .spatialOnly = settings.spatialOnly};
  const Guides guides =
      addPrepareGuides(graph, inputs, settings.guides, guideNeeds(stages, inputs.scene, false), inspection);
  FlrRegressionSettings regression = settings.regression;
  if (settings.spatialOnly) regression.sigma = settings.singleFrameSigma;
  const auto filter = [&](const FilterInput& input) {
    const fg::Texture occlusion = regression.occlusionGuide
                                      ? addAmbientOcclusion(graph, inputs.frame, guides, settings.occlusion)
                                      : fg::Texture{};
    return addFlrRegression(graph, input.lighting, input.alpha, guides, occlusion, input.target(graph, "filtered"),
                            regression, inspection);
  };
  return addTemporalStages(graph, inputs, guides, output, stages, filter, inspection);
}

}  // namespace walr
