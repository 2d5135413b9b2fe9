#include "passes/flnr.h"

#include "passes/guide_network.h"
#include "passes/network_weights.h"

namespace walr {

fg::Texture addFlnr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const FlnrSettings& settings) {
  const GuideNetwork network{kSmallFlnrWidths, smallFlnrWeights()};
  return addFlrWithNetwork(graph, inputs, output, settings, network);
}

}  // namespace walr
