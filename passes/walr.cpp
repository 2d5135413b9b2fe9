#include "passes/walr.h"

namespace walr {

fg::Texture addWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const WalrSettings& settings) {
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  const fg::Texture accumulated = addTemporalAccumulation(graph, inputs, guides, settings.accumulation);
  const fg::Texture filtered = addWeightedRegression(graph, inputs.frame, accumulated, guides, settings.regression);
  return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.antialiasing);
}

}  // namespace walr
