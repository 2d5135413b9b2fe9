#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/plan.h"

namespace fg {

/// For every transient in a heap: the resources that last owned any of its bytes before its first use, most recent
/// first. Frames repeat, so that a frame's first owners follow the last ones of the frame before; a resource that
/// shares its bytes with nobody follows itself.
std::vector<std::vector<std::uint32_t>> previousOwners(const Plan& plan);

}  // namespace fg
