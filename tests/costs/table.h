#pragma once

#include <string>
#include <vector>

#include "samples/estimate/machine.h"
#include "tests/costs/method_costs.h"

namespace walr::costs {

/// Costs of a method as a table in Markdown: a line per pass and one for their sums. README.md explains the columns.
std::string costTable(const MethodCosts& costs, const Machine& machine);

}  // namespace walr::costs
