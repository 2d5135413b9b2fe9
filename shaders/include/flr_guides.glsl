// The guides of one pixel: depth, and what `packedGuides` fetches. With OCCLUSION that comes from `features`, else from
// `shadingNormal`; with OCCLUSION and LEARNED, from `learned`, too. Needs: `depth`.
#ifndef WALR_FLR_GUIDES_GLSL
#define WALR_FLR_GUIDES_GLSL
#include "flr.glsl"
#include "surface.glsl"

struct PackedGuides {
  uint surface;
#ifdef LEARNED
  vec3 learned;
#endif
};

#ifdef OCCLUSION
uniform utexture2D features;
#ifdef LEARNED
uniform texture2D learned;
#endif

PackedGuides packedGuides(ivec2 p) {
  PackedGuides packed;
  packed.surface = texelFetch(features, p, 0).x;
#ifdef LEARNED
  packed.learned = texelFetch(learned, p, 0).rgb;
#endif
  return packed;
}

float depthAt(ivec2 p) { return unpackDepthBesideNormal(texelFetch(depth, p, 0).x); }

float[kFeatures] unpackGuides(PackedGuides packed, float z) {
  const NormalAndOcclusion s = unpackNormalAndOcclusion(packed.surface);
#ifdef LEARNED
  const vec3 l = packed.learned;
  return float[](s.normal.x, s.normal.y, s.normal.z, 1.0 / z, s.occlusion, l.x, l.y, l.z);
#else
  return float[](s.normal.x, s.normal.y, s.normal.z, 1.0 / z, s.occlusion);
#endif
}
#else
uniform utexture2D shadingNormal;

PackedGuides packedGuides(ivec2 p) { return PackedGuides(texelFetch(shadingNormal, p, 0).x); }
float depthAt(ivec2 p) { return unpackDepth(texelFetch(depth, p, 0).x); }

float[kFeatures] unpackGuides(PackedGuides packed, float z) {
  const vec3 n = unpackLongNormal(packed.surface);
  return float[](n.x, n.y, n.z, 1.0 / z);
}
#endif

#endif
