#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// For every resource in a heap: the resources that last owned any of its bytes before its first use, most recent
/// first. Frames repeat: the first owner in a frame follows the last owner in the frame before. Where heaps swap, that
/// owner lay in the partner heap. A resource that shares its bytes with no other follows itself. A history's `current`
/// follows its `previous`.
/// @return indexed by resource
std::vector<std::vector<std::uint32_t>> previousOwners(const Plan& plan);

}  // namespace fg
