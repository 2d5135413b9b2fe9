// The four history pixels around a reprojected position, each tested on its own.
// With PACKED, histories are packed (utexture2D) as `unpackHistory` knows.
#ifndef WALR_HISTORY_TAPS_GLSL
#define WALR_HISTORY_TAPS_GLSL

#ifdef PACKED
#define HISTORY_TEXTURE utexture2D
vec4 historyTexel(utexture2D history, ivec2 q) { return unpackHistory(texelFetch(history, q, 0).x); }
#else
#define HISTORY_TEXTURE texture2D
vec4 historyTexel(texture2D history, ivec2 q) { return texelFetch(history, q, 0); }
#endif

struct HistoryTaps {
  ivec2 base;      // The upper left one.
  vec2 fraction;   // Position past its centre, in [0, 1).
  uint accepted;   // Bit i says that tap i, in the order of `historyTap`, shows the surface.
};
const uint kAllTaps = 15u;

int tapsRejected(HistoryTaps taps) { return 4 - bitCount(taps.accepted); }

ivec2 tapOffset(int i) { return ivec2(i & 1, i >> 1); }
ivec2 historyTap(HistoryTaps taps, int i) { return taps.base + tapOffset(i); }

// Bilinear weights of the taps that show the surface, 0 of the others.
vec4 tapWeights(HistoryTaps taps) {
  const vec2 f = taps.fraction, g = 1.0 - taps.fraction;
  const vec4 bilinear = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  return bilinear * vec4((uvec4(taps.accepted) >> uvec4(0u, 1u, 2u, 3u)) & 1u);
}

// Taps that sum to less say next to nothing about the position between them.
const float kLeastTapWeight = 0.01;

struct TapMean {
  vec4 sum;
  float weights;
};

void add(inout TapMean mean, float weight, vec4 texel) {
  if (weight <= 0.0 || texel.a == 0.0) return;
  mean.sum += weight * texel;
  mean.weights += weight;
}

vec4 meanOf(TapMean mean) { return mean.weights > kLeastTapWeight ? mean.sum / mean.weights : vec4(0.0); }

// Mean over the taps that show the surface and hold a sample: alpha is the number of samples behind a history pixel,
// and one without any holds no light rather than black. 0 where there is no history at all.
vec4 meanOfTaps(HISTORY_TEXTURE history, HistoryTaps taps) {
  const vec4 weights = tapWeights(taps);
  TapMean mean = TapMean(vec4(0.0), 0.0);
  for (int i = 0; i < 4; ++i)
    if (weights[i] > 0.0) add(mean, weights[i], historyTexel(history, historyTap(taps, i)));
  return meanOf(mean);
}

// Kept taps let later stages read histories of their own where accumulation has read its history. A pixel's texel, one
// R32_UINT, is one of three things:
//   where there is a surface   its motion and which taps show it (packTaps)
//   where there is none        kNoSurfaceTaps, for readers that find so from this texel
//                              or the light that passes through (packPassThrough of packed_light.glsl), for packed
//                              anti-aliasing, which finds so from its filter's result (kFilteredNoSurface)
// The second and the third are told apart by what is asked of the accumulation, not by the texel.
// The motion is two halves whose two lowest mantissa bits make room for the accept bits, which leaves it a relative
// rounding of 2^-9: 1/64 of a pixel where a surface moves by 8 to 16.
const uint kNoSurfaceTaps = 0xffffffffu;
const uint kMotionBits = 0xfffcfffcu;

// The nearest motion that can be kept, ties to even. What the taps are tested at must be this very motion, lest rounding
// shift the taps under their accept bits.
vec2 keepableMotion(vec2 motion) {
  motion = clamp(motion, vec2(-32768.0), vec2(32768.0));
  const uvec2 bits = floatBitsToUint(motion);
  const vec2 rounded = uintBitsToFloat((bits + 0x3fffu + ((bits >> 15) & 1u)) & ~0x7fffu);
  return mix(rounded, vec2(0.0), lessThan(abs(motion), vec2(6.103515625e-5)));
}

// The four around where a pixel was, in a previous picture of another size: see FrameConstants. Precise, lest stages that
// keep taps and stages that read them round to different sides of a pixel's centre.
HistoryTaps tapsAround(ivec2 p, vec2 motion, vec2 previousPixelFromPixel) {
  precise const vec2 position =
      (vec2(p) + motion) * previousPixelFromPixel + (0.5 * previousPixelFromPixel - 0.5);
  const vec2 base = floor(position);
  return HistoryTaps(ivec2(base), position - base, 0u);
}

// Those of the four that lie in a picture of the given size.
uint tapsInside(HistoryTaps taps, ivec2 size) {
  uint inside = 0u;
  for (int i = 0; i < 4; ++i) {
    const ivec2 q = historyTap(taps, i);
    if (all(greaterThanEqual(q, ivec2(0))) && all(lessThan(q, size))) inside |= 1u << i;
  }
  return inside;
}

// `motion` must be keepable.
uint packTaps(vec2 motion, uint accepted) {
  const uint bits = (accepted & 3u) | (accepted & 12u) << 14;
  return (packHalf2x16(motion) & kMotionBits) | bits;
}

// Of a pixel with a surface.
HistoryTaps unpackTaps(ivec2 p, uint kept, vec2 previousPixelFromPixel) {
  HistoryTaps taps = tapsAround(p, unpackHalf2x16(kept & kMotionBits), previousPixelFromPixel);
  taps.accepted = (kept & 3u) | (kept >> 14 & 12u);
  return taps;
}

#endif
