// The light that a spatial filter reads: its mean over time, or a host's frame as it comes.
// Needs: `accumulated` (texture2D; with PACKED utexture2D, which is always a mean). Else takes constant_id 20.
#ifndef WALR_LIGHT_GLSL
#define WALR_LIGHT_GLSL

// Alpha: number of samples behind the light. Of a host's frame there is one where the light is finite.
#ifdef PACKED
#include "packed_light.glsl"

vec4 lightAt(ivec2 q) { return unpackAccumulated(texelFetch(accumulated, q, 0).x); }
#else
#include "finite.glsl"

layout(constant_id = 20) const bool kAlphaIsSampleCount = true;

vec4 lightAt(ivec2 q) {
  const vec4 light = texelFetch(accumulated, q, 0);
  if (kAlphaIsSampleCount) return light;
  return isFinite(light.rgb) ? vec4(clamp(light.rgb, vec3(0.0), vec3(kLargestHalf)), 1.0) : vec4(0.0);
}
#endif

#endif
