// The guides of one pixel.
// With OCCLUSION they come from `features`, else from `shadingNormal`.
#ifndef WALR_FLR_GUIDES_GLSL
#define WALR_FLR_GUIDES_GLSL
#include "flr.glsl"
#include "surface.glsl"

#ifdef OCCLUSION
uniform utexture2D features;

float[kFeatures] guidesAt(ivec2 p, float z) {
  const NormalAndOcclusion s = unpackNormalAndOcclusion(texelFetch(features, p, 0).x);
  return float[](s.normal.x, s.normal.y, s.normal.z, 1.0 / z, s.occlusion);
}
#else
uniform utexture2D shadingNormal;

float[kFeatures] guidesAt(ivec2 p, float z) {
  const vec3 n = unpackNormal(texelFetch(shadingNormal, p, 0).x);
  return float[](n.x, n.y, n.z, 1.0 / z);
}
#endif

#endif
