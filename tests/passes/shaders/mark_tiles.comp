// Adds a number to the pixels of the tiles of a list, for tests of which tiles are in it and how often. Without
// LISTED_TILES: gives the number to all pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "include/listed_tiles.glsl"

layout(local_size_x = kTileSide, local_size_y = kTileSide) in;
layout(constant_id = 0) const uint kMark = 0;
#ifdef LISTED_TILES
layout(set = 0, binding = 0, r32ui) uniform uimage2D marks;
void mark(ivec2 p) { imageAtomicAdd(marks, p, kMark); }
#else
layout(set = 0, binding = 0, r32ui) uniform writeonly uimage2D marks;
void mark(ivec2 p) { imageStore(marks, p, uvec4(kMark)); }
#endif

void main() {
  const ivec2 p = pixelOfThread();
  if (all(lessThan(p, imageSize(marks)))) mark(p);
}
