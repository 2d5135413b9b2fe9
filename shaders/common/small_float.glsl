// Rounding to the unsigned floats of B10G11R11 in the shader itself: 6 mantissa bits in red and green, 5 in blue.
#ifndef WALR_SMALL_FLOAT_GLSL
#define WALR_SMALL_FLOAT_GLSL

// The nearest finite value of each channel, ties to even. Image stores may truncate (Vulkan, "Floating-Point Format
// Conversions"), which would darken red and green by half a percent and blue by a whole one.
vec3 nearestSmallFloats(vec3 v) {
  v = clamp(v, vec3(0.0), vec3(65024.0, 65024.0, 64512.0));
  const uvec3 dropped = uvec3(17u, 17u, 18u);  // Of 23 mantissa bits.
  const uvec3 bits = floatBitsToUint(v);
  const uvec3 ulp = uvec3(1u) << dropped;
  const vec3 normal = uintBitsToFloat((bits + (ulp >> 1) - 1u + ((bits >> dropped) & 1u)) & ~(ulp - 1u));
  const vec3 steps = vec3(1048576.0, 1048576.0, 524288.0);  // Multiples of 2^-20 and 2^-19 below 2^-14.
  const vec3 subnormal = roundEven(v * steps) / steps;
  return mix(normal, subnormal, lessThan(v, vec3(6.103515625e-5)));
}

#endif
