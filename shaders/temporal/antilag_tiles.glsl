// The sums from which antilag.comp computes the antilag factor.
// Needs: `outTiles` and workgroups of kAntilagTile squared.
#ifndef WALR_ANTILAG_TILES_GLSL
#define WALR_ANTILAG_TILES_GLSL
#define GROUP_SUM vec2
#include "common/group_sum.glsl"

// Writes the sums of the tile of this workgroup. All threads of the workgroup must call it.
void sumOverTile(float difference) {
  const vec2 sum = sumOverGroup(vec2(difference, difference * difference));
  if (gl_LocalInvocationIndex == 0u) imageStore(outTiles, ivec2(gl_WorkGroupID.xy), vec4(sum, 0.0, 0.0));
}

#endif
