#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Merge barriers of single subresources of one texture that differ in nothing but their range into as few rectangles
/// of mip levels and layers as neighbours allow.
/// @param barriers each with its position, for one resource; mip levels before layers at every position
void mergeRanges(const ResourceDecl& resource, std::vector<std::pair<std::uint32_t, PlannedBarrier>>& barriers);

}  // namespace fg
