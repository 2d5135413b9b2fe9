#pragma once

#include "passes/regression/block_regression.h"

namespace walr::test {

/// The regression over blocks and the reconstruction after it, as one filter.
inline fg::Texture addBlockFilter(StageGraph graph, fg::Buffer frame, const BlockLight& light, const Guides& guides,
                                  const BlockRegressionSettings& settings) {
  const BlockFits fits = addBlockRegression(graph, frame, light, guides, settings);
  const fg::Texture target =
      graph->texture("filtered", {VK_FORMAT_R16G16B16A16_SFLOAT, graph->textureDesc(guides.depth).extent});
  return addBlockReconstruction(graph, frame, light, guides, fits, target, settings);
}

}  // namespace walr::test
