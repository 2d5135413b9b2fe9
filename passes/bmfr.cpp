#include "passes/bmfr.h"

namespace walr {

fg::Texture addBmfr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const BmfrSettings& settings) {
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  if (settings.spatialOnly)
    return addBmfrFit(graph, inputs.frame, inputs.lighting, LightingAlpha::Unused, guides, output, settings.fit);

  const auto [accumulated, taps] = addTemporalAccumulationWithTaps(graph, inputs, guides, settings.accumulation);
  const fg::Texture fit = graph.texture("fit", graph.textureDesc(output));
  const fg::Texture fitted =
      addBmfrFit(graph, inputs.frame, accumulated, LightingAlpha::SampleCount, guides, fit, settings.fit);
  const fg::Texture steady = addBmfrAccumulation(graph, fitted, guides, taps, settings.fittedAccumulation);
  return addTemporalAntialiasing(graph, inputs, guides, steady, output, settings.antialiasing);
}

}  // namespace walr
