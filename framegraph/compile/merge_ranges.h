#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Merge barriers of one texture that differ only in their range. Ranges of neighbouring mip levels and layers become
/// one rectangle.
/// @param barriers barriers of single subresources with their batches, ordered by batch, mip level and layer
void mergeRanges(const ResourceDecl& resource, std::vector<std::pair<std::uint32_t, PlannedBarrier>>& barriers);

}  // namespace fg
