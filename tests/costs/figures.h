#pragma once

#include <string>
#include <vector>

#include "samples/estimate/machine.h"
#include "samples/estimate/shader_figures.h"
#include "tests/costs/method_costs.h"

namespace walr::costs {

/// The methods' estimates on a machine, and the figures of all pipelines that they run at their own size and at
/// `kCommonExtents`. The size of the picture decides how many iterations some methods need.
/// @throws std::runtime_error naming what does not compile
FigureTable figuresOf(const std::vector<MethodCosts>& methods, NullDevice& device, const TripCounts& trips,
                      const Machine& machine);

/// Hold a committed table against the shaders.
/// @param now of the same methods, by the driver of the table
/// @returns one line per pipeline and method that only one of both has or that differs
std::vector<std::string> differences(const FigureTable& committed, const FigureTable& now);

}  // namespace walr::costs
