// The part of antilag in temporal accumulation: it reads the antilag factor of the last frame and writes the sums from
// which antilag.comp computes the next.
// Needs: `previousAntilag`; unless VIEW, `outTiles` and workgroups of kAntilagTile squared.
#ifndef WALR_ANTILAG_GLSL
#define WALR_ANTILAG_GLSL
#include "constants/antilag.h"
#include "gather_bilinear.glsl"

// The antilag factor at a position in the previous frame, bilinear, clamped at the borders. `position`: in pixels from
// the centre of the first pixel.
float antilagAt(vec2 position) {
  const vec2 tile = position / float(kAntilagTile) + (0.5 / float(kAntilagTile) - 0.5);  // From the first one's centre.
  const vec2 base = floor(tile);
  return gatherBilinear(previousAntilag, base, tile - base);
}

// The maximum history length at a position, frames: `maxHistory` at factor 0, none at factor 1. A pixel without a sample
// in this frame keeps one frame, because it has nothing else.
float longestHistory(vec2 position, float maxHistory, bool hasSample) {
  const float share = 1.0 - antilagAt(position);
  const float frames = share < kLeastHistoryShare ? 0.0 : maxHistory * share;
  return max(frames, hasSample ? 0.0 : 1.0);
}

#ifndef VIEW
#define GROUP_SUM vec2
#include "group_sum.glsl"

// Writes the sums of the tile of this workgroup. All threads of the workgroup must call it.
void sumOverTile(float difference) {
  const vec2 sum = sumOverGroup(vec2(difference, difference * difference));
  if (gl_LocalInvocationIndex == 0u) imageStore(outTiles, ivec2(gl_WorkGroupID.xy), vec4(sum, 0.0, 0.0));
}
#endif

#endif
