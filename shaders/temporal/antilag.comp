// Antilag (passes/WALR.md, 3): how far the light has changed, for each tile of 8 x 8 pixels. The antilag factor is 0
// where history counts in full and 1 where it does not count. What is at rest may have a longer one: below 0, the factor
// says how much longer.
// score = |sum d| / sqrt(sum d^2) over a window of tiles, where d is the luminance of this frame's sample less that of
// history. If the light has not changed, the score is normally distributed with standard deviation 1, whatever the
// noise; a single firefly cannot raise it above 1.
// Fireflies: the brightest sample that the next frame lets pass at this place, by the mean square of the samples of the
// window. It rises at once, so that it follows light, and falls by half of the way on a logarithmic scale. If the window
// was black, it is not known. At default settings it is 42 times the root mean square, so that light passes that one sample
// in 1,800 holds.
// AT_REST: history may be longer at rest. STEERED: other passes tell, too, how far it is to be shortened.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "common/half.glsl"
#include "temporal/antilag.h"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture2D tiles;  // Sums over a tile. x: of d; y: of d^2; z: of squares of samples; w: number of samples.
layout(constant_id = 1) const int kRadius = 3;  // Of the window of tiles.
#ifdef STEERED
uniform texture2D steering;  // Limits that the previous frame has measured (residual_statistics.comp), of its size.
#endif
#ifdef AT_REST
#include "conventions/frame.h"
layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D previousInnovations;  // Of the previous frame, of its size.
#endif
uniform texture2D previous;  // Of what this pass writes.
#ifdef AT_REST
layout(rgba16f) uniform writeonly image2D outFactor;  // y: the brightest sample; zw: TileInnovations, cube roots.
layout(r32f) uniform writeonly image2D outInnovations;  // Of each tile: x of `tiles`.
layout(r32ui) uniform writeonly uimage2D outShortening;  // Of the history of anti-aliasing: bits of a float.
#else
layout(rg16f) uniform writeonly image2D outFactor;  // y: the brightest sample.
#endif
layout(push_constant) uniform PushConstants { AntilagConstants constants; };

ivec2 tilesOfImage() { return textureSize(tiles, 0); }
const int kSharedLeast = 0;
float windowWeight(int offset) { return 1.0; }  // All tiles of the window count alike.
#include "common/window_sum.glsl"

#ifdef AT_REST
#include "temporal/tile_innovations.glsl"

// The antilag factor. `ofChange`: by the change of light alone; `before`: of the previous frame. At rest `least` is below
// 0. A small change ends the longer history there, which then grows by a frame in each frame.
float withLeast(float ofChange, float least, float before) {
  if (least >= 0.0) return max(ofChange, least);
  const float longer = mix(1.0 - least, 1.0, min(4.0 * ofChange, 1.0));
  return max(1.0 - (1.0 - ofChange) * longer, before - constants.oneFrame);
}
#endif

void main() {
  const vec4 sum = windowSum(tiles, ivec2(0));
#ifdef AT_REST
  const TileInnovations ofFrame = innovationsAround();
#endif
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = tilesOfImage();
  if (any(greaterThanEqual(tile, size))) return;
  const float score = sum.y > 0.0 ? abs(sum.x) * inversesqrt(sum.y) : 0.0;
  const float ofChange = clamp((score - constants.scoreLow) / (constants.scoreHigh - constants.scoreLow), 0.0, 1.0);
  const vec4 before = textureSize(previous, 0) == size ? texelFetch(previous, tile, 0) : vec4(0.0);
#ifdef AT_REST
  const TileInnovations innovations = withEarlier(ofFrame, before);
#ifdef STEERED
  const vec2 steered = textureSize(steering, 0) == size ? texelFetch(steering, tile, 0).xy : vec2(0.0);
#else
  const vec2 steered = vec2(0.0);
#endif
  const float longer = leastAtRest(innovations, before.x), least = longer < 0.0 ? longer : steered.x;
  const float factor = withLeast(ofChange, least, before.x);
  imageStore(outShortening, tile, uvec4(floatBitsToUint(factor < -1.0 ? factor + 1.0 : steered.y)));
#else
  const float factor = ofChange;
#endif
  const float now = sum.w > 0.0 ? sqrt(constants.mostSquare * sum.z / sum.w) : 0.0;
  const float brightest = max(now, sqrt(now * before.y));
#ifdef AT_REST
  imageStore(outFactor, tile, nearestHalf(vec4(factor, brightest, storedInnovations(innovations))));
  imageStore(outInnovations, tile, texelFetch(tiles, tile, 0).xxxx);
#else
  imageStore(outFactor, tile, nearestHalf(vec4(factor, brightest, 0.0, 0.0)));
#endif
}
