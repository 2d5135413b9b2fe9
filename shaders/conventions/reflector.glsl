// What tells of the light that a pixel reflects, in a texel of RG32_UINT. First word: the shading normal (surface.glsl).
// Second word, from the lowest bit: roughness, 8 bits; frames behind the mean that follows, 8 bits; the mean over time of
// the surface's depth over the distance of what it reflects, a half.
#ifndef WALR_REFLECTOR_GLSL
#define WALR_REFLECTOR_GLSL
#include "conventions/surface.glsl"

// Roughness up to which a pixel reflects one image, so that its own samples tell the distance.
const float kSharpUpTo = 0.1;

struct ReflectedDistance {
  float inverse;  // The surface's depth over the distance; 0: infinitely far, or not known.
  float frames;
};

uvec2 packReflector(uint packedNormal, float roughness, ReflectedDistance distance) {
  const uvec2 levels = uvec2(vec2(roughness * 255.0, min(distance.frames, 255.0)) + 0.5);
  return uvec2(packedNormal, levels.x | levels.y << 8 | packHalf2x16(vec2(0.0, distance.inverse)));
}
float roughnessOf(uvec2 reflector) { return float(reflector.y & 0xffu) / 255.0; }
ReflectedDistance distanceOf(uvec2 reflector) {
  return ReflectedDistance(unpackHalf2x16(reflector.y).y, float(bitfieldExtract(reflector.y, 8, 8)));
}

#endif
