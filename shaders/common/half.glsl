// Rounding to half precision in the shader itself.
#ifndef WALR_HALF_GLSL
#define WALR_HALF_GLSL
#include "common/finite.glsl"

// The nearest finite half of each value, ties to even. Image stores may round up or down (Vulkan, "Floating-Point
// Format Conversions"). Where they truncate, a running mean that is stored in every frame would darken by half a
// percent.
vec4 nearestHalf(vec4 v) {
  v = clamp(v, vec4(-kLargestHalf), vec4(kLargestHalf));
  const uvec4 bits = floatBitsToUint(v);
  const vec4 normal = uintBitsToFloat((bits + 0xfffu + ((bits >> 13) & 1u)) & ~0x1fffu);
  const vec4 subnormal = roundEven(v * 16777216.0) / 16777216.0;  // Multiples of 2^-24 below 2^-14.
  return mix(normal, subnormal, lessThan(abs(v), vec4(6.103515625e-5)));
}

// Two halves in a word. Values beyond the largest half become it.
uint packHalves(float low, float high) {
  return packHalf2x16(clamp(vec2(low, high), vec2(-kLargestHalf), vec2(kLargestHalf)));
}

#endif
