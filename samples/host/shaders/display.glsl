// Converts linear light to display values as walr::writePng does: tone map x / (1 + x), then sRGB transfer function.
#ifndef WALR_HOST_DISPLAY_GLSL
#define WALR_HOST_DISPLAY_GLSL
#include "common/finite.glsl"

float encodeSrgb(float linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

vec3 display(vec3 linear) {
  if (!isFinite(linear)) return vec3(1.0, 0.0, 1.0);
  const vec3 positive = max(linear, vec3(0.0));
  const vec3 mapped = positive / (1.0 + positive);
  return vec3(encodeSrgb(mapped.r), encodeSrgb(mapped.g), encodeSrgb(mapped.b));
}

#endif
