// What antilag.comp says of a place: the antilag factor, how far history is to be shortened because the light has
// changed, and how bright a pixel may be.
#ifndef WALR_ANTILAG_GLSL
#define WALR_ANTILAG_GLSL
#include "temporal/antilag.h"
#include "temporal/temporal_accumulation.h"
#include "common/gather_bilinear.glsl"

// A position among the tiles of antilag, from the centre of the first one. `position`: in pixels from the centre of the
// first pixel.
vec2 amongAntilagTiles(vec2 position) {
  return position / float(kAntilagTile) + (0.5 / float(kAntilagTile) - 0.5);
}

struct TileLimits {
  float factor;      // Antilag factor.
  float brightest;  // Sample that passes, in its brightest channel; 0: unknown.
};
const TileLimits kNoTileLimits = TileLimits(0.0, 0.0);

// The limits at a position in the frame of `tiles`, bilinear, clamped at the borders. `position`: in pixels from the
// centre of the first pixel.
TileLimits tileLimitsAt(sampler2D tiles, vec2 position) {
  const vec2 tile = amongAntilagTiles(position), base = floor(tile), f = tile - base;
  const vec2 at = (base + 1.0) / vec2(textureSize(tiles, 0));
  return TileLimits(bilinear(textureGather(tiles, at, 0), f), bilinear(textureGather(tiles, at, 1), f));
}

float brightestChannel(vec3 c) { return max(max(c.r, c.g), c.b); }

// The factor that holds a brightness back to `brightest`, and further where it is so much larger that there is no room
// for one of its kind.
float heldBack(float brightness, float brightest) {
  const float ratio = brightest / max(brightness, 1e-18);
  return brightest > 0.0 ? min(1.0, min(ratio, kFireflyRoom * ratio * ratio)) : 1.0;
}

// This frame's light as far as it passes. Accumulation takes it in by the limits of the last frame, which differ little.
vec3 withoutFirefly(vec3 light, float brightest) { return light * heldBack(brightestChannel(light), brightest); }

// The maximum history length for an antilag factor, frames: `maxHistory` at factor 0, none at factor 1.
float longestHistory(float factor, float maxHistory) {
  const float share = 1.0 - factor;
  return share < kLeastHistoryShare ? 0.0 : maxHistory * share;
}

// A pixel without a sample in this frame keeps one frame of history, because it has nothing else.
float longestHistoryOf(bool hasSample, float longest) { return hasSample ? longest : max(longest, 1.0); }

// Whether history is longer than antilag lets it be, and not by rounding of its packed length alone.
bool isTooLong(float history, float longest) {
  return history > max(kLengthRounding * longest, 0.5);
}

// The mean m = h + n (y - h) / N of history h and n samples with the mean y, where N = `mean.a`, with at most `longest`
// samples of history in it.
vec4 withLongestHistory(vec4 mean, vec3 y, float n, float longest) {
  const float history = mean.a - n;
  if (!isTooLong(history, longest)) return mean;
  const vec3 h = max((mean.a * mean.rgb - n * y) / history, vec3(0.0));
  const float length = longest + n;
  return vec4(mix(h, y, n / length), length);
}

#endif
