#pragma once

#include <vector>

#include "framegraph/declare/topology.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Which passes are executed, and why the others are not.
struct Culling {
  std::vector<bool> live;          ///< Indexed like `GraphDesc::passes`.
  std::vector<CulledPass> culled;  ///< Ordered by name.
};

/// Keep the passes with side effects and those that contribute to an export, to a kept pass, or to a history whose
/// `previous` a kept pass reads. Drop all others.
Culling cull(const Topology& topology);

}  // namespace fg
