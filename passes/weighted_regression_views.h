#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "passes/debug_views.h"

namespace walr {

/// The views that `addWeightedRegression` can show. "NAME" looks into the last iteration, "NAME.T" into iteration T, as
/// if it were the last.
std::vector<ViewInfo> weightedRegressionViews();

/// Which quantity of which iteration a view's name asks for.
struct RegressionView {
  std::uint32_t quantity = 0;  ///< `kView` of atrous.comp.
  std::uint32_t iteration = 0;
};

/// @throws std::invalid_argument naming a view or an iteration that there is not, and those that there are
RegressionView parseRegressionView(std::string_view name, std::uint32_t iterations);

}  // namespace walr
