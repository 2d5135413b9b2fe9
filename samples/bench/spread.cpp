#include "samples/bench/spread.h"

#include <algorithm>
#include <cmath>

namespace walr {

Spread spread(std::vector<double> values) {
  std::ranges::sort(values);
  const auto quantile = [&](double share) {
    const double position = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], position - static_cast<double>(below));
  };
  return {quantile(0.5), quantile(0.05), quantile(0.95)};
}

}  // namespace walr
