#pragma once

#include <vector>

#include "framegraph/compile/cull.h"
#include "framegraph/declare/memory_model.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// Every resource's usage flags over all executed passes, and what memory the device asks for it.
std::vector<PlannedResource> requirements(const GraphDesc& graph, const Culling& culling, const MemoryModel& memory);

/// By index into `GraphDesc::resources`: true for transients that share memory, which exported ones do not.
std::vector<bool> aliasable(const GraphDesc& graph);

/// By index into `GraphDesc::histories`: true for those that transients may alias. They are read every frame and not
/// exported.
std::vector<bool> aliasableHistories(const GraphDesc& graph, const std::vector<PlannedResource>& resources);

}  // namespace fg
