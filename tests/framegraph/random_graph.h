#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"

namespace fg::test {

/// How large random graphs are.
struct RandomGraphLimits {
  std::uint32_t minPasses = 1;
  std::uint32_t maxPasses = 14;
};

/// A valid graph drawn from a seed: textures of several sizes, some with mip levels and layers, buffers, uploads,
/// imports, exports and histories; compute, raster and transfer accesses; several versions written whole, in part or in
/// place; passes without effect. All passes are callbacks that record nothing.
Graph randomGraph(std::uint64_t seed, const RandomGraphLimits& limits = {});

/// The same graph with passes, resources, histories and exports registered in another order.
GraphDesc shuffled(const GraphDesc& graph, std::uint64_t seed);

}  // namespace fg::test
