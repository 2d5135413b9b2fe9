// History taps: the four history pixels around a reprojected position. Each is tested on its own and accepted if it
// shows the same surface.
// PACKED: histories are packed light (utexture2D), which the includer's `unpackHistory` unpacks.
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
  ivec2 base;      // The upper left tap.
  vec2 fraction;   // Offset of the position from that tap's centre, in [0, 1).
  uint accepted;   // Bit i: tap i, in the order of `historyTap`, is accepted.
};
const uint kAllTaps = 15u;

int tapsRejected(HistoryTaps taps) { return 4 - bitCount(taps.accepted); }

ivec2 tapOffset(int i) { return ivec2(i & 1, i >> 1); }
ivec2 historyTap(HistoryTaps taps, int i) { return taps.base + tapOffset(i); }

// Bilinear weights of the accepted taps; 0 for the others.
vec4 tapWeights(HistoryTaps taps) {
  const vec2 f = taps.fraction, g = 1.0 - taps.fraction;
  const vec4 bilinear = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  return bilinear * vec4((uvec4(taps.accepted) >> uvec4(0u, 1u, 2u, 3u)) & 1u);
}

// If the weights sum to less, the taps tell next to nothing about the position between them.
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

// Bilinear mean of the accepted taps that have a history; 0 if there is none. Alpha is the history length: a pixel of
// length 0 is without light, not black, and does not count.
vec4 meanOfTaps(HISTORY_TEXTURE history, HistoryTaps taps) {
  const vec4 weights = tapWeights(taps);
  TapMean mean = TapMean(vec4(0.0), 0.0);
  for (int i = 0; i < 4; ++i)
    if (weights[i] > 0.0) add(mean, weights[i], historyTexel(history, historyTap(taps, i)));
  return meanOf(mean);
}

// Kept taps: temporal accumulation keeps what its reprojection found in a texture, R32_UINT, so that later stages read
// histories of their own without testing again. A texel is one of three things:
//   where there is a surface   motion and accept bits (packTaps)
//   where there is none        kNoSurfaceTaps, for readers that learn it from this texel
//                              or the pass-through (packPassThrough of packed_light.glsl), for packed
//                              anti-aliasing, which learns it from the filter's result (kFilteredNoSurface)
// The texel does not tell the second from the third; the reader knows which of them accumulation was asked for.
// Motion is stored as two halves. The accept bits take the two lowest mantissa bits of each, which leaves motion a
// relative rounding error of 2^-9: 1/64 of a pixel where a surface moves by 8 to 16.
const uint kNoSurfaceTaps = 0xffffffffu;
const uint kMotionBits = 0xfffcfffcu;

// Rounds motion to what kept taps can hold, ties to even. Taps must be tested at this very motion: rounding after the
// test could shift the taps under their accept bits.
vec2 keepableMotion(vec2 motion) {
  motion = clamp(motion, vec2(-32768.0), vec2(32768.0));
  const uvec2 bits = floatBitsToUint(motion);
  const vec2 rounded = uintBitsToFloat((bits + 0x3fffu + ((bits >> 15) & 1u)) & ~0x7fffu);
  return mix(rounded, vec2(0.0), lessThan(abs(motion), vec2(6.103515625e-5)));
}

// The history taps of pixel `p`, none of them accepted yet. The previous frame may have another size (see
// FrameConstants). `precise`, so that stages that keep taps and stages that read them never round to different sides of
// a pixel's centre.
HistoryTaps tapsAround(ivec2 p, vec2 motion, vec2 previousPixelFromPixel) {
  precise const vec2 position =
      (vec2(p) + motion) * previousPixelFromPixel + (0.5 * previousPixelFromPixel - 0.5);
  const vec2 base = floor(position);
  return HistoryTaps(ivec2(base), position - base, 0u);
}

// Accept bits of the taps that lie inside an image of the given size.
uint tapsInside(HistoryTaps taps, ivec2 size) {
  uint inside = 0u;
  for (int i = 0; i < 4; ++i) {
    const ivec2 q = historyTap(taps, i);
    if (all(greaterThanEqual(q, ivec2(0))) && all(lessThan(q, size))) inside |= 1u << i;
  }
  return inside;
}

// `motion`: a result of keepableMotion.
uint packTaps(vec2 motion, uint accepted) {
  const uint bits = (accepted & 3u) | (accepted & 12u) << 14;
  return (packHalf2x16(motion) & kMotionBits) | bits;
}

// `kept`: texel of a pixel with a surface.
HistoryTaps unpackTaps(ivec2 p, uint kept, vec2 previousPixelFromPixel) {
  HistoryTaps taps = tapsAround(p, unpackHalf2x16(kept & kMotionBits), previousPixelFromPixel);
  taps.accepted = (kept & 3u) | (kept >> 14 & 12u);
  return taps;
}

#endif
