#include "passes/regression/window_fit.h"

#include <algorithm>
#include <cmath>

namespace walr {

std::uint32_t fittingIterations(std::uint32_t height, std::uint32_t size) {
  const long wanted = std::lround(std::log(height / (10.0 * size)) / std::log(3.0));
  return static_cast<std::uint32_t>(std::max(wanted, 1L));
}

std::uint32_t fittingBlockSize(std::uint32_t height) {
  return std::max(height / 43, 4U);
}

std::uint32_t fittingWindow(std::uint32_t height) {
  std::uint32_t window = 1;
  for (std::uint32_t t = 0; t < fittingIterations(height); ++t) window *= 3;
  return window;
}

}  // namespace walr
