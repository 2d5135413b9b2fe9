#pragma once

#include <vector>

namespace walr {

/// Median and quantiles of measured values.
struct Spread {
  double median = 0.0;
  double p5 = 0.0;   ///< 5 % of the values lie below it.
  double p95 = 0.0;  ///< 5 % of the values lie above it.
};

/// Quantiles with linear interpolation between order statistics (Hyndman and Fan 1996, type 7).
/// @param values  at least one
Spread spread(std::vector<double> values);

}  // namespace walr
