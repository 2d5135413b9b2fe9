// The pixel of a thread: with LISTED_TILES in the tiles of a list (list_tiles.comp) alone, else in the whole picture.
// Needs workgroups of kTileSide squared, and with LISTED_TILES `tileLists`. Takes constant_id 9.
#ifndef WALR_LISTED_TILES_GLSL
#define WALR_LISTED_TILES_GLSL
#include "constants/tiles.h"

#ifdef LISTED_TILES
layout(constant_id = 9) const uint kTileListHeaderAt = 0;  // Words.
layout(set = 0, binding = 30, std430) readonly buffer tileLists { uint words[]; };

// Outside every picture in the last row's workgroups beyond the list.
ivec2 pixelOfThread() {
  const uint i = gl_WorkGroupID.y * kTileListColumns + gl_WorkGroupID.x;
  if (i >= words[kTileListHeaderAt + 3u]) return ivec2(1 << 20);
  const uint word = words[kTileListHeaderAt + kTileListHeader + i];
  const uvec2 tile = uvec2(word & 0xffffu, word >> 16);
  return ivec2(uint(kTileSide) * tile + gl_LocalInvocationID.xy);
}
#else
ivec2 pixelOfThread() { return ivec2(gl_GlobalInvocationID.xy); }
#endif

#endif
