#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Merge barriers of one texture that are equal but for their range. Ranges of neighbouring mip levels and layers
/// become one rectangle.
/// @param barriers of single subresources, each with its position; ordered by position, then mip level, then array
/// layer
void mergeRanges(const ResourceDecl& resource, std::vector<std::pair<std::uint32_t, PlannedBarrier>>& barriers);

}  // namespace fg
