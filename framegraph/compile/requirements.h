#pragma once

#include <vector>

#include "framegraph/compile/cull.h"
#include "framegraph/declare/memory_model.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Usage flags of every resource over all executed passes, and the memory that the device requires for it.
std::vector<PlannedResource> requirements(const GraphDesc& graph, const Culling& culling, const MemoryModel& memory);

/// Indexed like `GraphDesc::resources`: true for transients that may share memory, that is, all that are not exported.
std::vector<bool> aliasable(const GraphDesc& graph);

/// Indexed like `GraphDesc::histories`: true for those that transients may alias, which are read every frame and not
/// exported.
std::vector<bool> aliasableHistories(const GraphDesc& graph, const std::vector<PlannedResource>& resources);

}  // namespace fg
