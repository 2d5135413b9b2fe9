// Innovations of tiles (passes/AT_REST.md): sums over a tile of the differences of this frame's samples from history.
// If the light changes slowly, those of successive frames agree, and history is too long (Mehra 1970). Noise alone parts
// them as long as history grows, and lets them disagree where it does not.
// Needs: what antilag.comp declares, and window_sum.glsl with the tiles of this frame shared.
#ifndef WALR_TILE_INNOVATIONS_GLSL
#define WALR_TILE_INNOVATIONS_GLSL
#include "common/cube_roots.glsl"

// Sums over windows of tiles, in which a frame fades as it ages.
struct TileInnovations {
  float products;  // Of a tile's innovation with that of the previous frame.
  float squares;   // Of that of the previous frame.
};

// Of this frame. All threads must call it after the window's sum of `tiles`.
TileInnovations innovationsAround() {
  const bool hasPrevious = textureSize(previousInnovations, 0) == tilesOfImage();
  for (int i = int(gl_LocalInvocationIndex); i < kSide * kSide; i += kGroup * kGroup) {
    const ivec2 tile = firstOfWindows() + ivec2(i % kSide, i / kSide);
    const float before = hasPrevious && isTile(tile) ? texelFetch(previousInnovations, tile, 0).x : 0.0;
    sharedTiles[i] = vec4(before * sharedTiles[i].x, before * before, 0.0, 0.0);
  }
  barrier();
  const vec2 sums = sharedWindowSum().xy;
  return TileInnovations(sums.x, sums.y);
}

// With those of earlier frames. `previous`: what the previous frame has written. Innovations by a change of light that
// has shortened history say nothing of what is left of it.
TileInnovations withEarlier(TileInnovations ofFrame, vec4 previous) {
  const float kept = 1.0 - 1.0 / 8.0;  // Statistics last for eight frames.
  const vec2 sums = vec2(ofFrame.products, ofFrame.squares) + kept * cubes(vec4(previous.zw, 0.0, 0.0)).xy;
  const float counted = 1.0 - clamp(previous.x, 0.0, 1.0);
  return TileInnovations(counted * sums.x, counted * sums.y);
}

vec2 storedInnovations(TileInnovations innovations) {
  return cubeRoots(vec4(innovations.products, innovations.squares, 0.0, 0.0)).xy;
}

// Whether the camera stands still, but for jitter and rounding. Accumulation tells what is at rest before it.
bool isCameraAtRest() {
  if (frame.rayFromPixel.xy != frame.previousRayFromPixel.xy || frame.previousPixelFromPixel != vec2(1.0)) return false;
  const float rounding = 1e-6;  // Of the host's matrices.
  for (int i = 0; i < 4; ++i) {
    const vec4 moved = abs(frame.previousViewFromView[i] - mat4(1.0)[i]);
    if (any(greaterThan(moved, vec4(rounding)))) return false;
  }
  return true;
}

// The least antilag factor. `before`: the factor of the previous frame. At rest, history grows with every frame as long as
// innovations do not agree.
float leastAtRest(TileInnovations innovations, float before) {
  if (innovations.squares == 0.0 || !isCameraAtRest()) return 0.0;
  const float gain = 2.0, fullGain = 8.0;  // Up to so many frames: what a slope may change falls with the history's length.
  const float frames = max(1.0 - before, 1.0) + constants.oneFrame;  // Over the longest history.
  const float slope = innovations.products / innovations.squares;
  const float limited = min(fullGain * constants.oneFrame / frames, 1.0);
  const float steered = slope > 0.0 ? frames * (1.0 - gain * limited * slope) - constants.oneFrame : frames;
  return 1.0 - clamp(steered, 1.0, constants.restFactor);
}

#endif
