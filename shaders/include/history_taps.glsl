// The four history pixels around a reprojected position, each tested on its own.
#ifndef WALR_HISTORY_TAPS_GLSL
#define WALR_HISTORY_TAPS_GLSL

struct HistoryTaps {
  ivec2 base;       // The upper left one.
  vec2 fraction;    // Position past its centre, in [0, 1).
  vec4 weights;     // Bilinear weights of those that show the surface, with sum 1; in the order of `historyTap`.
  bool any, all;    // Whether one, and whether every one, of the four shows it.
};

ivec2 tapOffset(int i) { return ivec2(i & 1, i >> 1); }
ivec2 historyTap(HistoryTaps taps, int i) { return taps.base + tapOffset(i); }

// `accepted`: bit i says that tap i shows the surface.
HistoryTaps acceptTaps(ivec2 base, vec2 fraction, uint accepted) {
  const vec2 f = fraction, g = 1.0 - fraction;
  const vec4 bilinear = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  const vec4 weights = bilinear * vec4(uvec4(accepted, accepted >> 1, accepted >> 2, accepted >> 3) & 1u);
  const float sum = dot(weights, vec4(1.0));
  // Below a hundredth of a pixel the remaining taps say next to nothing about this position.
  const bool any = sum > 0.01;
  return HistoryTaps(base, fraction, any ? weights / sum : vec4(0.0), any, accepted == 15u);
}

vec4 meanOfTaps(texture2D history, HistoryTaps taps) {
  vec4 mean = vec4(0.0);
  for (int i = 0; i < 4; ++i)
    if (taps.weights[i] > 0.0) mean += taps.weights[i] * texelFetch(history, historyTap(taps, i), 0);
  return mean;
}

// In one RG32_UINT: the base as two 16-bit integers, the fractions in 14 bits each, the four accept bits.
const float kFractionSteps = 16384.0;

uvec2 packTaps(HistoryTaps taps) {
  const uvec2 base = uvec2(taps.base) & 0xffffu;
  const uvec2 fraction = uvec2(min(taps.fraction * kFractionSteps, vec2(kFractionSteps - 1.0)));
  const uvec4 bits = uvec4(greaterThan(taps.weights, vec4(0.0))) << uvec4(28u, 29u, 30u, 31u);
  return uvec2(base.x | base.y << 16, fraction.x | fraction.y << 14 | bits.x | bits.y | bits.z | bits.w);
}

HistoryTaps unpackTaps(uvec2 packed) {
  const ivec2 base = ivec2(int(packed.x << 16) >> 16, int(packed.x) >> 16);
  const uvec2 fraction = uvec2(packed.y, packed.y >> 14) & 0x3fffu;
  return acceptTaps(base, vec2(fraction) / kFractionSteps, packed.y >> 28);
}

#endif
