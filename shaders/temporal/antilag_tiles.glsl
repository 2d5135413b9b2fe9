// Sums over a tile of this frame's light, and those from which antilag.comp computes the antilag factor.
// Needs: workgroups of kAntilagTile squared, and with ANTILAG `outTiles`.
#ifndef WALR_ANTILAG_TILES_GLSL
#define WALR_ANTILAG_TILES_GLSL
#define GROUP_SUM vec4
#include "common/group_sum.glsl"
#include "temporal/antilag.h"

// The share of this frame's light in the tile that may belong to a firefly: 1 where one or two pixels have nearly all of
// it, 0 where more share it. `brightness`: of this pixel's sample. All threads of the workgroup must call it.
float fireflyShareOfTile(float brightness) {
  const vec2 sum = sumOverGroup(vec4(brightness, brightness * brightness, 0.0, 0.0)).xy;
  barrier();  // The shared memory is free for other sums.
  const float pixels = sum.x * sum.x / max(sum.y, 1e-37);  // Pixels of equal brightness that have the same two sums.
  return 1.0 - clamp(pixels - kFireflyWitnesses, 0.0, 1.0);
}

#ifdef ANTILAG
// Writes the sums of the tile of this workgroup. All threads of the workgroup must call it.
// `square`: of the brightness of this frame's sample; `samples`: 1 if there is one.
void sumOverTile(float difference, float square, float samples) {
  const vec4 sum = sumOverGroup(vec4(difference, difference * difference, square, samples));
  if (gl_LocalInvocationIndex == 0u) imageStore(outTiles, ivec2(gl_WorkGroupID.xy), sum);
}
#endif

#endif
