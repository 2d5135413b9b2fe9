#pragma once

#include <string>
#include <vector>

#include "tests/costs/method_costs.h"

namespace walr::costs {

/// Whether passes stay within what a GPU runs well, with any compiler: no pass spills registers or uses scratch memory,
/// and a SIMD holds three waves or more.
/// @returns one line per violation, naming method, pass, figure and limit
std::vector<std::string> violations(const std::vector<MethodCosts>& methods);

/// Passes with loops that trip_counts.json does not know, so that they have no estimate.
/// @returns one line per pass, with the way out
std::vector<std::string> unknownLoops(const std::vector<MethodCosts>& methods);

}  // namespace walr::costs
