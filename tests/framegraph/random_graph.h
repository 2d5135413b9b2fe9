#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"

namespace fg::test {

/// Number of passes of random graphs.
struct RandomGraphLimits {
  std::uint32_t minPasses = 1;
  std::uint32_t maxPasses = 14;
};

/// A valid random graph. It has textures of several sizes, some with mip levels and layers, buffers, uploads, imports,
/// exports and histories. Passes have compute, raster and transfer accesses and write versions as a whole, in part or
/// in place; some have no effect. All passes are callbacks that record nothing.
Graph randomGraph(std::uint64_t seed, const RandomGraphLimits& limits = {});

/// The same graph with passes, resources, histories and exports registered in another order.
GraphDesc shuffled(const GraphDesc& graph, std::uint64_t seed);

}  // namespace fg::test
