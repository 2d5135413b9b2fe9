#include "passes/flr.h"

namespace walr {

fg::Texture addFlr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const FlrSettings& settings) {
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  if (settings.spatialOnly) {
    FlrRegressionSettings regression = settings.regression;
    regression.sigma = settings.singleFrameSigma;
    return addFlrRegression(graph, inputs.lighting, LightingAlpha::Unused, guides, output, regression);
  }

  const fg::Texture accumulated = addTemporalAccumulation(graph, inputs, guides, settings.accumulation);
  const fg::Texture filtered = graph.texture("filtered", graph.textureDesc(output));
  const fg::Texture regressed =
      addFlrRegression(graph, accumulated, LightingAlpha::SampleCount, guides, filtered, settings.regression);
  return addTemporalAntialiasing(graph, inputs, guides, regressed, output, settings.antialiasing);
}

}  // namespace walr
