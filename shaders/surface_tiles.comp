// Which tiles of the picture show a surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/tiles.h"
#include "include/surface.glsl"

layout(local_size_x = kTileSide, local_size_y = kTileSide) in;

layout(set = 0, binding = 0) uniform utexture2D depth;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D outTiles;  // 1: some pixel does.

shared uint surface;

void main() {
  if (gl_LocalInvocationIndex == 0u) surface = 0u;
  barrier();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(p, textureSize(depth, 0))) && unpackDepth(texelFetch(depth, p, 0).x) > 0.0) atomicOr(surface, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u) imageStore(outTiles, ivec2(gl_WorkGroupID.xy), uvec4(surface));
}
