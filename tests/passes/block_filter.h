#pragma once

#include "passes/block_regression.h"

namespace walr::test {

/// The regression over blocks and the reconstruction after it, as one filter.
inline fg::Texture addBlockFilter(StageGraph graph, fg::Buffer frame, const BlockLight& light, const Guides& guides,
                                  const BlockRegressionSettings& settings) {
  const BlockFits fits = addBlockRegression(graph, frame, light, guides, settings);
  return addBlockReconstruction(graph, frame, light, guides, fits, settings);
}

}  // namespace walr::test
