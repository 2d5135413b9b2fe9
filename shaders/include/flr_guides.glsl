// The guides of one pixel.
// Needs: `depth`, `shadingNormal` (utexture2D) and, with OCCLUSION, `occlusion` (texture2D).
#ifndef WALR_FLR_GUIDES_GLSL
#define WALR_FLR_GUIDES_GLSL
#include "flr.glsl"
#include "surface.glsl"

float[kFeatures] guidesAt(ivec2 p, float z) {
  const vec3 n = unpackNormal(texelFetch(shadingNormal, p, 0).x);
#ifdef OCCLUSION
  return float[](n.x, n.y, n.z, 1.0 / z, texelFetch(occlusion, p, 0).x);
#else
  return float[](n.x, n.y, n.z, 1.0 / z);
#endif
}

#endif
