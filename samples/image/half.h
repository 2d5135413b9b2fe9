#pragma once

#include <algorithm>
#include <cmath>

#include <Imath/half.h>

namespace walr {

/// Nearest half float. Finite values beyond the range become the largest half float of the same sign, not infinity.
inline Imath::half toHalf(float value) {
  constexpr float kLargest = 65504.0F;
  return {std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : value};
}

}  // namespace walr
