// The light that a spatial filter reads: the accumulated mean, or the host's lighting of one frame.
// Needs: `accumulated`: texture2D, or with PACKED utexture2D, which is always an accumulated mean. Without PACKED it
// takes constant_id 20.
#ifndef WALR_LIGHT_GLSL
#define WALR_LIGHT_GLSL

// Alpha: number of samples in the mean. For the lighting of one frame it is 1 where the light is finite, else 0.
#ifdef PACKED
#include "conventions/packed_light.glsl"

vec4 lightAt(ivec2 q) { return unpackAccumulated(texelFetch(accumulated, q, 0).x); }
#else
#include "common/finite.glsl"

layout(constant_id = 20) const bool kAlphaIsSampleCount = true;

vec4 lightAt(ivec2 q) {
  const vec4 light = texelFetch(accumulated, q, 0);
  if (kAlphaIsSampleCount) return light;
  return isFinite(light.rgb) ? vec4(clampedRadiance(light.rgb), 1.0) : vec4(0.0);
}
#endif

#endif
