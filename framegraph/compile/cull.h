#pragma once

#include <vector>

#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Which passes are executed, and why the others are not.
struct Culling {
  std::vector<bool> live;          ///< By index into `GraphDesc::passes`.
  std::vector<CulledPass> culled;  ///< By name.
};

/// Drop the passes that reach no export, no side effect, and no history whose previous contents a kept pass reads.
Culling cull(const Topology& topology);

}  // namespace fg
