// The guides of one pixel: depth, and what `packedGuides` fetches.
// Needs: `depth`, which holds the geometric normal, too, if `normals` holds ambient occlusion (surface.glsl).
#ifndef WALR_FLR_GUIDES_GLSL
#define WALR_FLR_GUIDES_GLSL
#include "flr.glsl"
#include "surface.glsl"

uniform utexture2D normals;  // Shading normals, and with kOcclusionGuide ambient occlusion.
uniform texture2D learned;   // Read with kLearnedGuides.

struct PackedGuides {
  uint normal;
  vec3 learned;
};

PackedGuides packedGuides(ivec2 p) {
  return PackedGuides(texelFetch(normals, p, 0).x, kLearnedGuides ? texelFetch(learned, p, 0).rgb : vec3(0.0));
}

float depthAt(ivec2 p) {
  const uint packed = texelFetch(depth, p, 0).x;
  return kOcclusionGuide ? unpackDepthBesideNormal(packed) : unpackDepth(packed);
}

// Guides that are not used are 0.
float[kFeatures] unpackGuides(PackedGuides packed, float z) {
  const NormalAndOcclusion s = kOcclusionGuide ? unpackNormalAndOcclusion(packed.normal)
                                               : NormalAndOcclusion(unpackLongNormal(packed.normal), 0.0);
  const vec3 l = packed.learned;
  return float[](s.normal.x, s.normal.y, s.normal.z, 1.0 / z, s.occlusion, l.x, l.y, l.z);
}

#endif
