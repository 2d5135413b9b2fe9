// The antilag factor (antilag.comp): how far history is to be shortened, because the light has changed.
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

// The antilag factor at a position in the frame of `factors`, bilinear, clamped at the borders. `position`: in pixels
// from the centre of the first pixel.
float antilagAt(sampler2D factors, vec2 position) {
  const vec2 tile = amongAntilagTiles(position), base = floor(tile);
  return gatherBilinear(factors, base, tile - base);
}

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
