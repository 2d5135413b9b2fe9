// Catmull-Rom reading of a history texture.
#ifndef WALR_BICUBIC_GLSL
#define WALR_BICUBIC_GLSL
#include "history_taps.glsl"

// Weights of the four pixels around a position `f` past the second.
vec4 catmullRom(float f) {
  return vec4(f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (1.5 * f - 2.5), f * (0.5 + f * (2.0 - 1.5 * f)),
              f * f * (0.5 * f - 0.5));
}

// Radiance is bicubic where all four inner pixels show the surface and none of the outer ones is sky or otherwise
// without history (length 0), whose light would ring into the surface; else the mean of the inner ones that show it.
// Alpha, the history length, is that mean in either case.
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
