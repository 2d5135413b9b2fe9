#include "passes/flnr.h"

#include "passes/guide_network.h"
#include "passes/network_weights.h"

namespace walr {

FlnrSettings paperFlnr() {
  FlnrSettings settings;
  settings.network = NetworkKind::Paper;
  return settings;
}

fg::Texture addFlnr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const FlnrSettings& settings) {
  const bool small = settings.network == NetworkKind::Small;
  const GuideNetwork network{settings.network, kFlnrWidths, small ? smallFlnrWeights() : paperFlnrWeights()};
  return addFlrWithNetwork(graph, inputs, output, settings, network);
}

}  // namespace walr
