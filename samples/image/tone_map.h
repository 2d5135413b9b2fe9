#pragma once

#include <algorithm>
#include <cmath>

namespace walr {

/// The tone map of all PNG images and error metrics: Reinhard's x / (1 + x) (Reinhard et al. 2002, eq. 3), for linear
/// scene-referred x >= 0. Negative values count as 0.
inline float toneMap(float value) {
  const float positive = std::max(value, 0.0F);
  return std::isinf(positive) ? 1.0F : positive / (1.0F + positive);
}

/// The sRGB transfer function (IEC 61966-2-1), for values in 0..1.
inline float encodeSrgb(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

}  // namespace walr
