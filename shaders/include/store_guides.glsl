// Writes the guides of a pixel (guides.glsl). Declares the textures that they go to.
#ifndef WALR_STORE_GUIDES_GLSL
#define WALR_STORE_GUIDES_GLSL
#include "guides.glsl"

layout(r32ui) uniform writeonly uimage2D outDepth;
#ifdef OCCLUSION
layout(r32ui) uniform writeonly uimage2D outFeatures;
#else
layout(r32ui) uniform writeonly uimage2D outShadingNormal;
#endif
#if defined(GEOMETRIC_NORMAL) && !defined(OCCLUSION)
layout(r32ui) uniform writeonly uimage2D outGeometricNormal;
#endif

void storeGuides(ivec2 p, PackedGuides guides) {
  imageStore(outDepth, p, uvec4(guides.depth));
#ifdef OCCLUSION
  imageStore(outFeatures, p, uvec4(guides.features));
#else
  imageStore(outShadingNormal, p, uvec4(guides.features));
#endif
#if defined(GEOMETRIC_NORMAL) && !defined(OCCLUSION)
  imageStore(outGeometricNormal, p, uvec4(guides.geometricNormal));
#endif
}

#endif
