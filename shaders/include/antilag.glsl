// The part of antilag in temporal accumulation: it reads the antilag factor of the last frame and writes the sums from
// which antilag.comp computes the next.
// Needs: `previousAntilag`; unless VIEW, `outTiles` and workgroups of kAntilagTile squared.
#ifndef WALR_ANTILAG_GLSL
#define WALR_ANTILAG_GLSL
#include "constants/antilag.h"

// The antilag factor at a position in pixels of the previous frame, bilinear, clamped at the borders.
float antilagAt(vec2 pixel) {
  const vec2 position = pixel / float(kAntilagTile) - 0.5;
  const ivec2 base = ivec2(floor(position));
  const vec2 f = fract(position);
  const ivec2 last = textureSize(previousAntilag, 0) - 1;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1);
    const vec2 weight = mix(1.0 - f, f, vec2(offset));
    sum += weight.x * weight.y * texelFetch(previousAntilag, clamp(base + offset, ivec2(0), last), 0).x;
  }
  return sum;
}

// The maximum history length at a position: `maxHistory` at factor 0, one sample at factor 1.
float longestHistory(vec2 pixel, float maxHistory) { return mix(maxHistory, 1.0, antilagAt(pixel)); }

#ifndef VIEW
const uint kTileThreads = uint(kAntilagTile * kAntilagTile);
shared vec2 tileSums[kTileThreads];

// Writes the sums of the tile of this workgroup. All threads of the workgroup must call it.
void sumOverTile(float difference) {
  const uint thread = gl_LocalInvocationIndex;
  tileSums[thread] = vec2(difference, difference * difference);
  barrier();
  for (uint n = kTileThreads / 2u; n > 0u; n /= 2u) {
    if (thread < n) tileSums[thread] += tileSums[thread + n];
    barrier();
  }
  if (thread == 0u) imageStore(outTiles, ivec2(gl_WorkGroupID.xy), vec4(tileSums[0], 0.0, 0.0));
}
#endif

#endif
