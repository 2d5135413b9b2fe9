// Sixteen halves in two RGBA32_UINT texels: the fourteen moments, the root of the mean squared luminance (the square
// itself would overflow a half from 256 on) and the sample count.
#ifndef WALR_MOMENTS_STORAGE_GLSL
#define WALR_MOMENTS_STORAGE_GLSL
#include "finite.glsl"
#include "moments.glsl"

struct PackedMoments {
  uvec4 a, b;
};

uint packHalves(float low, float high) {
  return packHalf2x16(clamp(vec2(low, high), vec2(-kLargestHalf), vec2(kLargestHalf)));
}

PackedMoments packMoments(Moments m) {
  PackedMoments p;
  p.a = uvec4(packHalves(m.x.x, m.x.y), packHalves(m.y.r, m.y.g), packHalves(m.y.b, m.xx.x),
              packHalves(m.xx.y, m.xx.z));
  p.b = uvec4(packHalves(m.yu.r, m.yu.g), packHalves(m.yu.b, m.yv.r), packHalves(m.yv.g, m.yv.b),
              packHalves(sqrt(m.luma2), m.samples));
  return p;
}

Moments unpackMoments(PackedMoments p) {
  const vec2 a0 = unpackHalf2x16(p.a.x), a1 = unpackHalf2x16(p.a.y), a2 = unpackHalf2x16(p.a.z),
             a3 = unpackHalf2x16(p.a.w);
  const vec2 b0 = unpackHalf2x16(p.b.x), b1 = unpackHalf2x16(p.b.y), b2 = unpackHalf2x16(p.b.z),
             b3 = unpackHalf2x16(p.b.w);
  return Moments(a0, vec3(a1, a2.x), vec3(a2.y, a3), vec3(b0, b1.x), vec3(b1.y, b2), b3.x * b3.x, b3.y);
}

#endif
