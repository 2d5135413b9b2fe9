// Four channels of a network's layer as halves, the unit of its buffers: all texels of the first four channels, row by row,
// then all of the next four.
#ifndef WALR_HALVES_GLSL
#define WALR_HALVES_GLSL
#include "common/finite.glsl"

vec4 unpackHalves(uvec2 packed) { return vec4(unpackHalf2x16(packed.x), unpackHalf2x16(packed.y)); }
uvec2 packHalves(vec4 v) {
  const vec4 finite = clamp(v, -kLargestHalf, kLargestHalf);
  return uvec2(packHalf2x16(finite.xy), packHalf2x16(finite.zw));
}

int halvesIndex(ivec2 p, int group, ivec2 extent) { return (group * extent.y + p.y) * extent.x + p.x; }

#endif
