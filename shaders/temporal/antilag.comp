// Antilag (passes/WALR.md, 3): how far the light has changed, for each tile of 8 x 8 pixels. The antilag factor is 0
// where history counts in full and 1 where it does not count.
// score = |sum d| / sqrt(sum d^2) over a window of tiles, where d is the luminance of this frame's sample less that of
// history. If the light has not changed, the score is normally distributed with standard deviation 1, whatever the
// noise; a single firefly cannot raise it above 1.
// Fireflies: the brightest sample that the next frame lets pass at this place, by the mean square of the samples of the
// window. It rises at once, so that it follows light, and falls by half of the way on a logarithmic scale. If the window
// was black, it is not known. At default settings it is 42 times the root mean square, so that light passes that one sample
// in 1,800 holds.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/half.glsl"
#include "temporal/antilag.h"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D tiles;  // Sums over a tile. x: of d; y: of d^2; z: of squares of samples; w: number of samples.
layout(constant_id = 0) const bool kHasLeast = false;
layout(constant_id = 1) const int kRadius = 3;  // Of the window of tiles.
uniform texture2D least;  // Least factor of each tile; of the previous frame's size, and not read where that is another.
uniform texture2D previous;  // Of what this pass writes.
layout(rg16f) uniform writeonly image2D outFactor;  // y: the brightest sample.
layout(push_constant) uniform PushConstants { AntilagConstants constants; };

ivec2 tilesOfImage() { return textureSize(tiles, 0); }
const int kSharedLeast = 0;
float windowWeight(int offset) { return 1.0; }  // All tiles of the window count alike.
#include "common/window_sum.glsl"

void main() {
  const vec4 sum = windowSum(tiles, ivec2(0));
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = tilesOfImage();
  if (any(greaterThanEqual(tile, size))) return;
  const float score = sum.y > 0.0 ? abs(sum.x) * inversesqrt(sum.y) : 0.0;
  const float factor = clamp((score - constants.scoreLow) / (constants.scoreHigh - constants.scoreLow), 0.0, 1.0);
  const bool hasLeast = kHasLeast && textureSize(least, 0) == size;
  const float now = sum.w > 0.0 ? sqrt(constants.mostSquare * sum.z / sum.w) : 0.0;
  const float before = textureSize(previous, 0) == size ? texelFetch(previous, tile, 0).y : 0.0;
  const float withLeast = hasLeast ? max(factor, texelFetch(least, tile, 0).x) : factor;
  const float brightest = max(now, sqrt(now * before));
  imageStore(outFactor, tile, nearestHalf(vec4(withLeast, brightest, 0.0, 0.0)));
}
