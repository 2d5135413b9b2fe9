// Sorts the picture's tiles into lists by what the regression over blocks has to do in them, with the arguments of the
// dispatches that work on them. In which order a list has its tiles changes from run to run. CLEAR: empties the lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/tiles.h"

#ifdef CLEAR
#define LISTS_ACCESS writeonly
#else
#define LISTS_ACCESS
#endif
layout(set = 0, binding = 0, std430) LISTS_ACCESS buffer tileLists { uint words[]; };
layout(push_constant) uniform PushConstants { TileListConstants settings; };

uint headerOf(uint list) { return list * (kTileListHeader + settings.columns * settings.rows); }

#ifdef CLEAR
layout(local_size_x = 4) in;

void main() {
  for (uint list = 0u; list < kTileLists; ++list)
    words[headerOf(list) + gl_LocalInvocationIndex] = gl_LocalInvocationIndex == 2u ? 1u : 0u;
}
#else
#include "include/block_storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;  // Pixels per axis.

layout(set = 0, binding = 1) uniform utexture2D fitDepth;

// By the blocks whose fits the tile's pixels read, and by those it shows.
uint listOf(ivec2 tile) {
  const ivec2 firstPixel = kTileSide * tile, lastPixel = firstPixel + kTileSide - 1;
  // Those that lie less than a block from a pixel.
  const ivec2 first = max((2 * firstPixel + 1 + kBlockSize) / (2 * kBlockSize) - 1, ivec2(0));
  const ivec2 last = min((2 * lastPixel + kBlockSize) / (2 * kBlockSize), textureSize(fitDepth, 0) - 1);
  bool surface = false, growing = false;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const ivec2 block = ivec2(x, y);
      const uint packedDepth = texelFetch(fitDepth, block, 0).x;
      if (packedDepth == 0u) continue;
      growing = growing || !hasConverged(packedDepth);
      surface = surface || (all(greaterThanEqual(block, firstPixel / kBlockSize)) &&
                            all(lessThanEqual(block, lastPixel / kBlockSize)));
    }
  }
  if (!surface) return kTilesOfSky;
  return growing ? kTilesGrowing : kTilesConverged;
}

const uint kThreads = 64u;
shared uint ranks[kThreads];
shared uint starts[kTileLists];

// Number of threads up to this one in each list, eight bits a list.
uint inclusiveSums(uint has) {
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

uint countIn(uint list, uint sums) { return bitfieldExtract(sums, int(8u * list), 8); }

// Where the workgroup's tiles begin in a list.
uint append(uint list, uint count) {
  const uint header = headerOf(list);
  const uint start = atomicAdd(words[header + 3u], count);
  const uint end = start + count;
  atomicMax(words[header], min(end, kTileListColumns));
  atomicMax(words[header + 1u], (end + kTileListColumns - 1u) / kTileListColumns);
  return start;
}

void main() {
  const uvec2 tile = gl_GlobalInvocationID.xy;
  const bool inside = all(lessThan(tile, uvec2(settings.columns, settings.rows)));
  const uint list = inside ? listOf(ivec2(tile)) : kTileLists;
  const uint upToThis = inclusiveSums(inside ? 1u << 8u * list : 0u);
  if (gl_LocalInvocationIndex < kTileLists)
    starts[gl_LocalInvocationIndex] =
        append(gl_LocalInvocationIndex, countIn(gl_LocalInvocationIndex, ranks[kThreads - 1u]));
  barrier();
  if (!inside) return;
  const uint place = starts[list] + countIn(list, upToThis) - 1u;
  words[headerOf(list) + kTileListHeader + place] = tile.x | tile.y << 16;
}
#endif
