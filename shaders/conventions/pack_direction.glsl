// Packs the slopes of light over the normal in 64 bits, as walr/light_direction.glsl unpacks them: nine signed mantissas
// of 6 bits, of R, G and B in turn along x, y and z each, and the 8-bit exponent of their unit in the highest bits.
#ifndef WALR_PACK_DIRECTION_GLSL
#define WALR_PACK_DIRECTION_GLSL

const float kLargestMantissa = 31.0;

// `slopes`: column i holds the change of light, RGB, over that of the normal's component i. Mantissas are rounded to
// nearest: the error is at most 1/31 of the largest slope.
uvec2 packDirection(mat3 slopes) {
  const vec3 largest = max(max(abs(slopes[0]), abs(slopes[1])), abs(slopes[2]));
  const float brightest = max(max(largest.r, largest.g), largest.b);
  // The smallest power of two of which kLargestMantissa reach the largest slope. Below 2^-126 all slopes are 0.
  const uint exponent = (floatBitsToUint(brightest / kLargestMantissa) + 0x7fffffu) >> 23;
  if (exponent == 0u || exponent > 254u) return uvec2(0u);
  const float inverseUnit = 1.0 / uintBitsToFloat(exponent << 23);
  uvec2 packed = uvec2(0u, exponent << 24);
  for (int i = 0; i < 9; ++i) {
    const uint mantissa = uint(int(round(slopes[i % 3][i / 3] * inverseUnit))) & 63u;
    packed[i / 5] |= mantissa << 6 * (i % 5);
  }
  return packed;
}

#endif
