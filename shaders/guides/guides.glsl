// The guides of a pixel (passes/WALR.md, 1), and the textures that they go to: view depth (0 where there is nothing to
// denoise), the shading normal in octahedral form, and with GEOMETRIC_NORMAL the geometric normal.
// kOcclusion: the shading normal shares a word with ambient occlusion, and the geometric normal takes the lowest
// 12 bits of depth's word. Everything in the host's depth occludes, even a mirror, which is not denoised itself.
// NORMAL_APART: the geometric normal has a texture of its own, for use without kOcclusion.
// Needs: what host_surface.glsl needs, and with GEOMETRIC_NORMAL work groups of 8 x 8 threads.
// Takes constant_id 20 to 24.
#ifndef WALR_GUIDES_GLSL
#define WALR_GUIDES_GLSL
#include "guides/host_surface.glsl"

layout(constant_id = 22) const int kOcclusionRings = 4;
layout(constant_id = 24) const bool kOcclusion = false;
#include "guides/ambient_occlusion.glsl"
#ifdef GEOMETRIC_NORMAL
#include "guides/geometric_normal.glsl"
#endif

layout(r32ui) uniform writeonly uimage2D outDepth;
layout(r32ui) uniform writeonly uimage2D outFeatures;
#ifdef NORMAL_APART
layout(r32ui) uniform writeonly uimage2D outGeometricNormal;
#endif

// The guides of a pixel as textures hold them (surface.glsl). All of them are 0 without a surface.
struct PackedGuides {
  uint depth;            // With kOcclusion also the geometric normal.
  uint features;         // The shading normal, and with kOcclusion ambient occlusion.
  uint geometricNormal;  // With NORMAL_APART.
};

#ifdef GEOMETRIC_NORMAL
uint packedGeometricNormal(Surface surface) {
  const vec3 n = geometricNormalOf(surface);
  return kOcclusion ? packShortNormal(n) : packNormal(n);
}
#else
uint packedGeometricNormal(Surface surface) { return 0u; }
#endif

// The guides of this thread's pixel. All threads of a work group must call it, even those outside the image: these
// read as if there were sky.
PackedGuides guidesOfPixel() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 q = min(p, textureSize(hostDepth, 0) - 1);
  const float depthThere = texelFetch(hostDepth, q, 0).x;
  const float z = p == q ? depthThere : 0.0;
  const uint depthEnd = surfaceDepthEnd();
  const Surface surface = surfaceAt(q, z, depthEnd);
#ifdef GEOMETRIC_NORMAL
  shareInverseDepths(z, depthEnd);
  barrier();
#endif
  PackedGuides guides = PackedGuides(0u, 0u, 0u);
  if (surface.depth == 0.0) return guides;

  const uint geometricNormal = packedGeometricNormal(surface);
  if (kOcclusion) {
    guides.depth = packDepthNormal(surface.depth, geometricNormal);
    const float occlusion = ambientOcclusion(p, surface, depthEnd);
    guides.features = packNormalAndOcclusion(NormalAndOcclusion(surface.normal, occlusion));
  } else {
    guides.depth = packDepthSdf(surface.depth, 0u);
    guides.geometricNormal = geometricNormal;
    guides.features = packNormal(surface.normal);
  }
  return guides;
}

void storeGuides(ivec2 p, PackedGuides guides) {
  imageStore(outDepth, p, uvec4(guides.depth));
  imageStore(outFeatures, p, uvec4(guides.features));
#ifdef NORMAL_APART
  imageStore(outGeometricNormal, p, uvec4(guides.geometricNormal));
#endif
}

#endif
