#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"

namespace fg::test {

/// A graph like that of a denoiser: every pass reads the three textures before it and writes one; every eighth carries
/// a history.
Graph chainGraph(std::int64_t passes);

}  // namespace fg::test
