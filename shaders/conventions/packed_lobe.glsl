// The lobe of a pixel, stored.
#ifndef WALR_PACKED_LOBE_GLSL
#define WALR_PACKED_LOBE_GLSL
#include "conventions/lobe.glsl"
#include "conventions/surface.glsl"

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
