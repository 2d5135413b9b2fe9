// Reads a history texture with a Catmull-Rom filter.
#ifndef WALR_BICUBIC_GLSL
#define WALR_BICUBIC_GLSL
#include "history_taps.glsl"

// Weights of the four pixels around a position, which lies `f` pixels past the second.
vec4 catmullRom(float f) {
  return vec4(f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (1.5 * f - 2.5), f * (0.5 + f * (2.0 - 1.5 * f)),
              f * f * (0.5 * f - 0.5));
}

// Mean radiance and history length at the position of the history taps. Radiance is bicubic if all four history taps
// are accepted and none of the twelve pixels around them is without history (length 0), as sky is: the filter would
// ring its light into the surface. Otherwise radiance is the mean of the accepted taps. Alpha, the history length,
// always is.
vec4 bicubicOfTaps(HISTORY_TEXTURE history, HistoryTaps taps) {
  const vec4 wx = catmullRom(taps.fraction.x), wy = catmullRom(taps.fraction.y);
  const vec4 weights = tapWeights(taps);
  const ivec2 last = textureSize(history, 0) - 1;
  TapMean linear = TapMean(vec4(0.0), 0.0);
  vec3 cubic = vec3(0.0);
  float shortest = 1.0;
  [[unroll]] for (int j = 0; j < 4; ++j) {
    [[unroll]] for (int i = 0; i < 4; ++i) {
      const vec4 texel = historyTexel(history, clamp(taps.base + ivec2(i, j) - 1, ivec2(0), last));
      cubic += wx[i] * wy[j] * texel.rgb;
      shortest = min(shortest, texel.a);
      if ((i == 1 || i == 2) && (j == 1 || j == 2)) add(linear, weights[2 * j + i - 3], texel);
    }
  }
  const vec4 mean = meanOf(linear);
  return taps.accepted != kAllTaps || shortest == 0.0 ? mean : vec4(max(cubic, vec3(0.0)), mean.a);
}

#endif
