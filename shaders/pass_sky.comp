// What passes through a filter over tiles with surfaces: the light of the tiles without any. PACKED says of these tiles that
// they show no surface, and leaves their light to who reads that.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#define LISTED_TILES
#include "include/listed_tiles.glsl"

layout(local_size_x = kTileSide, local_size_y = kTileSide) in;

#ifdef PACKED
layout(set = 0, binding = 1, r32ui) uniform uimage2D filtered;
#include "include/packed_light.glsl"
void passSky(ivec2 p) { imageStore(filtered, p, uvec4(kNoFiltered)); }
#else
layout(set = 0, binding = 0) uniform texture2D passed;
layout(set = 0, binding = 1, rgba16f) uniform image2D filtered;
#include "include/passed_light.glsl"
void passSky(ivec2 p) { imageStore(filtered, p, vec4(passedLight(passed, p), 1.0)); }
#endif

void main() {
  const ivec2 p = pixelOfThread();
  if (all(lessThan(p, imageSize(filtered)))) passSky(p);
}
