// Antilag (passes/WALR.md, 3): how far the light has changed, for each tile of 8 x 8 pixels. The antilag factor is 0
// where history counts in full and 1 where it does not count.
// score = |sum d| / sqrt(sum d^2) over a window of tiles, where d is the luminance of this frame's sample less that of
// history. If the light has not changed, the score is normally distributed with standard deviation 1, whatever the
// noise; a single firefly cannot raise it above 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "temporal/antilag.h"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D tiles;  // x: sum of d over a tile; y: sum of d^2.
layout(constant_id = 0) const bool kHasLeast = false;
layout(constant_id = 1) const int kRadius = 3;  // Of the window of tiles.
uniform texture2D least;  // Least factor of each tile; of the previous frame's size, and not read where that is another.
layout(r32f) uniform writeonly image2D outFactor;
layout(push_constant) uniform PushConstants { AntilagConstants constants; };

ivec2 tilesOfImage() { return textureSize(tiles, 0); }
const int kSharedLeast = 0;
float windowWeight(int offset) { return 1.0; }  // All tiles of the window count alike.
#include "common/window_sum.glsl"

void main() {
  const vec2 sum = windowSum(tiles, ivec2(0)).xy;
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = tilesOfImage();
  if (any(greaterThanEqual(tile, size))) return;
  const float score = sum.y > 0.0 ? abs(sum.x) * inversesqrt(sum.y) : 0.0;
  const float factor = clamp((score - constants.scoreLow) / (constants.scoreHigh - constants.scoreLow), 0.0, 1.0);
  const bool hasLeast = kHasLeast && textureSize(least, 0) == size;
  imageStore(outFactor, tile, vec4(hasLeast ? max(factor, texelFetch(least, tile, 0).x) : factor));
}
