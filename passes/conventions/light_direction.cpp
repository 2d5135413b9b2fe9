#include "passes/conventions/light_direction.h"

#include <cmath>

namespace walr {

glm::mat3 lightSlopes(glm::uvec2 texel) {
  constexpr int kExponentBias = 127;
  const std::uint32_t exponent = texel.y >> 24U;
  const float unit = exponent == 0 ? 0.0F : std::ldexp(1.0F, static_cast<int>(exponent) - kExponentBias);
  glm::mat3 slopes;
  for (int i = 0; i < 9; ++i) {
    const int mantissa = static_cast<int>(texel[i / 5] >> static_cast<unsigned>(6 * (i % 5)) & 63U);
    slopes[i % 3][i / 3] = unit * static_cast<float>(mantissa < 32 ? mantissa : mantissa - 64);
  }
  return slopes;
}

}  // namespace walr
