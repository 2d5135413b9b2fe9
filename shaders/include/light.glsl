// The light that a spatial filter reads: its mean over time, or a host's frame as it comes.
// Needs: `accumulated` (texture2D). Takes constant_id 20.
#ifndef WALR_LIGHT_GLSL
#define WALR_LIGHT_GLSL
#include "finite.glsl"

layout(constant_id = 20) const bool kAlphaIsSampleCount = true;

// Alpha: number of samples behind the light. Of a host's frame there is one where the light is finite.
vec4 lightAt(ivec2 q) {
  const vec4 light = texelFetch(accumulated, q, 0);
  if (kAlphaIsSampleCount) return light;
  return isFinite(light.rgb) ? vec4(clamp(light.rgb, vec3(0.0), vec3(kLargestHalf)), 1.0) : vec4(0.0);
}

// Light of a pixel without a surface, which passes through as it is.
vec3 passedLight(ivec2 q) {
  const vec3 light = texelFetch(accumulated, q, 0).rgb;
  return isFinite(light) ? light : vec3(0.0);
}

#endif
