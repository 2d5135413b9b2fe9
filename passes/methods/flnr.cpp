#include "passes/methods/flnr.h"

#include "passes/network/guide_network.h"
#include "passes/network/network_weights.h"

namespace walr {

FlnrSettings paperFlnr() {
  FlnrSettings settings;
  settings.network = NetworkKind::Paper;
  return settings;
}

FlnrSettings fullFlnr() {
  FlnrSettings settings;
  settings.network = NetworkKind::Full;
  settings.regression.sigma = 10.0F;
  settings.singleFrameSigma = 20.0F;
  return settings;
}

fg::Texture addFlnr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const FlnrSettings& settings) {
  const GuideNetwork network{settings.network, kFlnrWidths, flnrWeights(settings.network)};
  return addFlrWithNetwork(graph, inputs, output, settings, network);
}

}  // namespace walr
