// Light of a pixel without a surface, which passes through as it is.
#ifndef WALR_PASSED_LIGHT_GLSL
#define WALR_PASSED_LIGHT_GLSL
#include "finite.glsl"

vec3 passedLight(texture2D from, ivec2 q) {
  const vec3 light = texelFetch(from, q, 0).rgb;
  return isFinite(light) ? light : vec3(0.0);
}

#endif
