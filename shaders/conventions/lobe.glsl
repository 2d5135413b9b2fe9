// The specular lobe of a pixel.
#ifndef WALR_LOBE_GLSL
#define WALR_LOBE_GLSL
#include "common/finite.glsl"
#include "conventions/surface.glsl"

// Linear roughness as the host wrote it; NaN and infinity count as rough.
float validRoughness(float r) { return isFinite(r) ? clamp(r, 0.0, 1.0) : 1.0; }

// Half angle of the lobe about the mirror direction, radians. `r`: linear roughness.
float lobeAngle(float r) { return 2.0 * atan(r * r); }

struct Lobe {
  vec3 direction;  // Of the mirrored view ray.
  float angle;     // lobeAngle.
  float nearness;  // View depth over the mean distance of what is reflected; 0: that is far away.
};

uvec2 packLobe(Lobe lobe) { return uvec2(packNormal(lobe.direction), packHalf2x16(vec2(lobe.angle, lobe.nearness))); }
Lobe unpackLobe(uvec2 packed) {
  const vec2 values = unpackHalf2x16(packed.y);
  return Lobe(unpackLongNormal(packed.x), values.x, values.y);
}

#endif
