// The guides of one pixel: depth, and what `packedGuides` fetches.
// Needs: `depth`, which holds the geometric normal, too, if `normals` holds ambient occlusion (surface.glsl).
#ifndef WALR_FLR_GUIDES_GLSL
#define WALR_FLR_GUIDES_GLSL
#include "regression/flr.glsl"
#include "conventions/surface.glsl"

uniform utexture2D normals;     // Shading normals, and with kOcclusionGuide ambient occlusion. Not read with kLearnedAlone.
uniform texture2D learned;      // Read with kLearnedGuides.
uniform texture2D moreLearned;  // Read with kLearnedAlone.

struct PackedGuides {
  uint normal;
  vec4 learned;
  float moreLearned;
};

PackedGuides packedGuides(ivec2 p) {
  return PackedGuides(kLearnedAlone ? 0u : texelFetch(normals, p, 0).x,
                      kLearnedGuides ? texelFetch(learned, p, 0) : vec4(0.0),
                      kLearnedAlone ? texelFetch(moreLearned, p, 0).x : 0.0);
}

float depthAt(ivec2 p) {
  const uint packed = texelFetch(depth, p, 0).x;
  return kOcclusionGuide ? unpackDepthBesideNormal(packed) : unpackDepth(packed);
}

NormalAndOcclusion unpackGeometry(uint normal) {
  return kOcclusionGuide ? unpackNormalAndOcclusion(normal) : NormalAndOcclusion(unpackLongNormal(normal), 0.0);
}

// Guides that are not used are 0.
float[kFeatures] unpackGuides(PackedGuides packed, float z) {
  const vec4 l = packed.learned;
  if (kLearnedAlone) return float[](l.x, l.y, l.z, l.w, packed.moreLearned, 0.0, 0.0, 0.0);
  const NormalAndOcclusion s = unpackGeometry(packed.normal);
  return float[](s.normal.x, s.normal.y, s.normal.z, 1.0 / z, s.occlusion, l.x, l.y, l.z);
}

#endif
