// Lists the tiles with a surface and those without, in the order of the picture, with the arguments of the dispatches
// that work on them. One workgroup: the lists are the same in every run.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/tiles.h"

const uint kThreads = 128u;  // As many as every device takes.
layout(local_size_x = 128) in;

layout(set = 0, binding = 0) uniform utexture2D tiles;
layout(set = 0, binding = 1, std430) writeonly buffer outSurfaces {
  uint surfaceGroups[3];
  uint surfaceCount;
  uint surfaces[];
};
layout(set = 0, binding = 2, std430) writeonly buffer outSky {
  uint skyGroups[3];
  uint skyCount;
  uint sky[];
};

shared uint ranks[kThreads];

// Number of threads up to this one that have something.
uint inclusiveSum(uint has) {
  const uint thread = gl_LocalInvocationIndex;
  ranks[thread] = has;
  barrier();
  for (uint n = 1u; n < kThreads; n *= 2u) {
    const uint before = thread >= n ? ranks[thread - n] : 0u;
    barrier();
    ranks[thread] += before;
    barrier();
  }
  return ranks[thread];
}

uint columnsOf(uint count) { return min(count, kTileListColumns); }
uint rowsOf(uint count) { return (count + kTileListColumns - 1u) / kTileListColumns; }

void main() {
  const uvec2 size = uvec2(textureSize(tiles, 0));
  const uint total = size.x * size.y;
  uint found = 0u;
  for (uint first = 0u; first < total; first += kThreads) {
    const uint i = first + gl_LocalInvocationIndex;
    const uvec2 tile = uvec2(i % size.x, i / size.x);
    const bool surface = i < total && texelFetch(tiles, ivec2(tile), 0).x != 0u;
    const uint before = found + inclusiveSum(uint(surface)) - uint(surface);
    const uint word = tile.x | tile.y << 16;
    if (surface) {
      surfaces[before] = word;
    } else if (i < total) {
      sky[i - before] = word;
    }
    found += ranks[kThreads - 1u];
    barrier();
  }
  if (gl_LocalInvocationIndex > 0u) return;
  surfaceCount = found;
  surfaceGroups[0] = columnsOf(found);
  surfaceGroups[1] = rowsOf(found);
  surfaceGroups[2] = 1u;
  const uint rest = total - found;
  skyCount = rest;
  skyGroups[0] = columnsOf(rest);
  skyGroups[1] = rowsOf(rest);
  skyGroups[2] = 1u;
}
