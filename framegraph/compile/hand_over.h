#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// For every resource in a heap: those that last owned any of its bytes before its first use, most recent first. Frames
/// repeat, so that a frame's first owners follow the last ones of the frame before, in the allocation that stood for
/// the partner then where heaps swap. A resource that shares its bytes with nobody follows itself; a history's
/// `current` follows its `previous`.
std::vector<std::vector<std::uint32_t>> previousOwners(const Plan& plan);

}  // namespace fg
