// WALR, share of the accumulated light (passes/WALR.md, 9): sums of the residuals in a window of tiles, where a frame
// fades as it ages. The innovations in this window tell how long history may be in the next frame, and the share how long
// that of anti-aliasing may be.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/accumulated_share.h"
#include "temporal/antilag.h"
#include "conventions/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kTileSize = 8;  // Pixels per axis, 5 to 8.
layout(constant_id = 1) const int kRadius = 5;    // Of the window of tiles.
layout(constant_id = 2) const int kBlockSize = 4;  // Pixels per axis.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D fitDepth;  // Of each block.
uniform texture2D sums;  // Of each tile: accumulated_share.glsl. Right half: of pixels beside an edge.
uniform texture2D innovationSums;  // xy: innovation.glsl; zw: products of residuals two pixels apart, by axis.
uniform texture2D previousStatistics;  // Cube roots.
uniform texture2D previousAgreement;
uniform texture2D previousSteering;
layout(rgba16f) uniform writeonly image2D outStatistics;  // Cube roots of sums as the above.
// xy: cube roots of the sums of the products two pixels apart; z: trust; w: tileState.
layout(rgba16f) uniform writeonly image2D outAgreement;
// For tiles of antilag. x: least antilag factor; y: how far anti-aliasing shortens its history: 0 not at all, 1 to none.
layout(rg32f) uniform writeonly image2D outSteering;
layout(push_constant) uniform PushConstants { ResidualStatisticsConstants constants; };
#include "common/cube_roots.glsl"
#include "regression/best_share.glsl"
#include "regression/quiet_tiles.glsl"
#include "conventions/surface.glsl"

float depthAtMiddle(ivec2 p) {
  return unpackDepth(texelFetch(fitDepth, min(p / kBlockSize, textureSize(fitDepth, 0) - 1), 0).x);
}
#include "regression/tile_before.glsl"

ivec2 tilesOfImage() { return textureSize(innovationSums, 0); }

// Whether the previous frame had the same tiles. Where the image has changed its size, statistics begin anew.
bool hasPrevious() { return frame.previousPixelFromPixel == vec2(1.0); }

// The tile that showed the middle of this one in the previous frame, if nothing but the camera moved.
ivec2 previousTile(ivec2 tile) { return ivec2(floor(tileBefore(tile, kTileSize, constants.tileOffset))); }

const int kAntilagSpan = 7 * kAntilagTile / kTileSize + 2;  // Tiles that a row of eight tiles of antilag spans.
const int kAntilagSide = kAntilagSpan + 2 * kRadius;
const int kSharedLeast = kAntilagSide * kAntilagSide;
// Falls from the middle to the window's border, so that statistics are local where light differs.
float windowWeight(int offset) { return 1.0 - float(abs(offset)) / float(kRadius + 1); }
#include "common/window_sum.glsl"

// How far the agreement of this frame's residuals with the history's is light that the fits miss, and not noise that
// both share, as resampled light has. Such noise differs from pixel to pixel: means around a pixel have little of it,
// and products of residuals two pixels apart almost none. What the fits miss goes on for some pixels, along one axis at
// least. `both`: sums of previousStatisticsAt; `far`: sums of the products two pixels apart, by axis.
// The limits are measured (passes/LEARNT.md, "Share of accumulated light").
float trustIn(vec4 both, vec2 far) {
  const float kFarWeight = 1.25, kNone = 0.75, kFull = 0.95;
  const float continuing = max(both.x, 0.0) + kFarWeight * max(abs(far.x), abs(far.y));
  return clamp((continuing / max(both.x + both.z, 1e-30) - kNone) / (kFull - kNone), 0.0, 1.0);
}

// A tile is quiet if no pixel can have a share: that of the longest history, which has the least noise, is too small.
// Where nothing has been measured, in a first frame or in the sky, it takes a second frame. `hasEdges`: whether pixels
// beside an edge have been measured in the tile itself. `before`: the state in the last frame.
float stateOf(vec4 interior, vec4 edge, bool hasEdges, float trust, float before) {
  if (interior == vec4(0.0) && edge == vec4(0.0)) return tileState(before > 0.0, 1.0);
  const float withEdges = hasEdges ? float(kQuietFrames) : max(framesWithEdges(before) - 1.0, 0.0);
  const float n = constants.maxHistory;
  const float share = max(bestShare(interior.xy, n, trust, constants.residualGain),
                          bestShare(interior.zw, n, trust, constants.residualGain));
  const float besideEdge = max(bestShare(edge.xy, n, trust, constants.residualEdgeGain),
                               bestShare(edge.zw, n, trust, constants.residualGain));
  return tileState(max(share, withEdges > 0.0 ? besideEdge : 0.0) < constants.quietShare, withEdges);
}

// The tile of this thread, of the image whose window has just been summed.
vec4 tileInShared() {
  const ivec2 t = ivec2(gl_LocalInvocationID.xy) + kRadius;
  return sharedTiles[t.y * kSide + t.x];
}

// All threads must call it.
void storeStatistics(ivec2 tile) {
  const ivec2 size = tilesOfImage(), rightHalf = ivec2(size.x, 0);
  vec4 interior = windowSum(sums, ivec2(0)), edge = windowSum(sums, rightHalf);
  const bool hasEdges = tileInShared() != vec4(0.0);
  vec2 far = windowSum(innovationSums, ivec2(0)).zw;
  if (any(greaterThanEqual(tile, size))) return;
  const ivec2 before = previousTile(tile);
  vec4 agreement = vec4(0.0);
  if (all(greaterThanEqual(before, ivec2(0))) && all(lessThan(before, size))) {
    agreement = texelFetch(previousAgreement, before, 0);
    const float kept = isQuiet(agreement.w) ? constants.keptQuiet : constants.kept;
    interior += kept * cubes(texelFetch(previousStatistics, before, 0));
    edge += kept * cubes(texelFetch(previousStatistics, before + rightHalf, 0));
    far += kept * cubes(agreement).xy;
  }
  imageStore(outStatistics, tile, cubeRoots(interior));
  imageStore(outStatistics, tile + rightHalf, cubeRoots(edge));
  const float trust = trustIn(interior + edge, far);
  const float state = stateOf(interior, edge, hasEdges, trust, agreement.w);
  imageStore(outAgreement, tile, vec4(cubeRoots(vec4(far, 0.0, 0.0)).xy, trust, state));
}

// The tile that holds the middle of a tile of antilag.
ivec2 tileOfSumsAt(ivec2 tile) {
  const int middle = kAntilagTile / 2 + constants.tileOffset;
  return min((kAntilagTile * tile + middle) / kTileSize, tilesOfImage() - 1);
}

// Sums of innovationTerms in the window around a tile, and the number of tiles that have some. All threads must call it.
vec3 innovationsAround(ivec2 tileOfSums) {
  const ivec2 first = tileOfSumsAt(ivec2(gl_WorkGroupID.xy) * kGroup);
  shareTiles(innovationSums, ivec2(0), first - kRadius, kAntilagSide);
  const ivec2 inShared = tileOfSums - first;
  vec3 sum = vec3(0.0);
  for (int y = 0; y <= 2 * kRadius; ++y) {
    for (int x = 0; x <= 2 * kRadius; ++x) {
      const vec2 terms = sharedTiles[(inShared.y + y) * kAntilagSide + inShared.x + x].xy;
      sum += vec3(terms, terms.y > 0.0 ? 1.0 : 0.0);
    }
  }
  return sum;
}

// The share of the accumulated light of a tile in the last frame's result.
float shareOf(ivec2 tileOfSums, float trust) {
  if (!hasPrevious()) return 0.0;
  const ivec2 ofEdges = tileOfSums + ivec2(tilesOfImage().x, 0);
  const vec4 sums =
      cubes(texelFetch(previousStatistics, tileOfSums, 0)) + cubes(texelFetch(previousStatistics, ofEdges, 0));
  return bestShare(sums.xy + sums.zw, constants.maxHistory, trust, constants.residualGain);
}

// How far anti-aliasing shortens its history. Its mean removes noise, and reprojection blurs it. Where accumulated light
// has a large share, there is little noise and much that blur would take away.
float shorteningAt(float share) {
  const float range = 0.5;  // Of shares, between no shortening and no history.
  return clamp((share - constants.antialiasingShare) / range, 0.0, 1.0);
}

// Changes the history length N of accumulation, for a tile of antilag, and stores the antilag factor with which history
// has this length. Stores how far anti-aliasing shortens its own, too. All threads must call it.
void storeHistoryLengths(ivec2 tile) {
  const ivec2 tileOfSums = tileOfSumsAt(tile);
  const vec3 sums = innovationsAround(tileOfSums);
  if (any(greaterThanEqual(tile, imageSize(outSteering)))) return;
  const float longest = constants.maxHistory, shortest = 2.0;  // Innovations need a history.
  const float previous = hasPrevious() ? texelFetch(previousSteering, tile, 0).x : 0.0;
  const float before = longest * (1.0 - previous) + 1.0;
  // The slope of the regression of innovations on those of the frame before is, without noise, how much more the last frame
  // should have counted. If only noise parts light and history, it is minus half of the share with which it counted. Means
  // over four pixels have a quarter of this while the camera stands still, and a ninth where quads of both frames overlap
  // by chance. What is missing is added.
  // Quiet tiles have innovations in every second frame. The slope of few tiles is noise.
  const float enough = 16.0, ofPixels = 0.82 * 0.5 / before;
  const float excess = sums.y > 0.0 ? sums.x / sums.y - ofPixels + constants.innovationBias : 0.0;
  // Noise that successive frames share lets innovations agree, too: history is shortened as far as there is trust.
  const float trust = hasPrevious() ? texelFetch(previousAgreement, tileOfSums, 0).z : 0.0;
  // Where accumulated light has a share, there is little noise. What quads show of its detail is less than pixels would.
  // What a slope may change falls with the length of a history, as the slope of noise does.
  const float share = shareOf(tileOfSums, trust), fullGain = 8.0;  // Up to so many frames.
  const float gain = constants.innovationGain * (1.0 + 8.0 * share) * min(fullGain / before, 1.0);
  const float change = min(sums.z / enough, 1.0) * gain * (excess > 0.0 ? trust * excess : excess);
  const float frames = clamp(before * (1.0 - change), shortest, max(longest, shortest));
  const float least = clamp(1.0 - (frames - 1.0) / longest, 0.0, 1.0);
  imageStore(outSteering, tile, vec4(least, shorteningAt(share), 0.0, 0.0));
}

void main() {
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  storeStatistics(tile);
  storeHistoryLengths(tile);
}
