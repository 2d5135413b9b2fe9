// The guides of one pixel: depth, and what `packedGuides` fetches. With OCCLUSION that comes from `features`, else from
// `shadingNormal`. Needs: `depth`.
#ifndef WALR_FLR_GUIDES_GLSL
#define WALR_FLR_GUIDES_GLSL
#include "flr.glsl"
#include "surface.glsl"

#ifdef OCCLUSION
uniform utexture2D features;

uint packedGuides(ivec2 p) { return texelFetch(features, p, 0).x; }
float depthAt(ivec2 p) { return unpackDepthBesideNormal(texelFetch(depth, p, 0).x); }

float[kFeatures] unpackGuides(uint packed, float z) {
  const NormalAndOcclusion s = unpackNormalAndOcclusion(packed);
  return float[](s.normal.x, s.normal.y, s.normal.z, 1.0 / z, s.occlusion);
}
#else
uniform utexture2D shadingNormal;

uint packedGuides(ivec2 p) { return texelFetch(shadingNormal, p, 0).x; }
float depthAt(ivec2 p) { return unpackDepth(texelFetch(depth, p, 0).x); }

float[kFeatures] unpackGuides(uint packed, float z) {
  const vec3 n = unpackLongNormal(packed);
  return float[](n.x, n.y, n.z, 1.0 / z);
}
#endif

#endif
