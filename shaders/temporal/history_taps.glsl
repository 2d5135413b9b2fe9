// History taps: the four history pixels around a reprojected position. Each is tested on its own and accepted if it
// shows the same surface.
// PACKED: histories are packed light (usampler2D), which the includer's `unpackHistory` unpacks. Needs `frame`
// (FrameConstants).
#ifndef WALR_HISTORY_TAPS_GLSL
#define WALR_HISTORY_TAPS_GLSL

#ifdef PACKED
#define HISTORY_TEXTURE usampler2D
vec4 historyTexel(usampler2D history, ivec2 q) { return unpackHistory(texelFetch(history, q, 0).x); }
#else
#define HISTORY_TEXTURE texture2D
vec4 historyTexel(texture2D history, ivec2 q) { return texelFetch(history, q, 0); }
#endif

struct HistoryTaps {
  ivec2 base;      // The upper left tap.
  vec2 fraction;   // Offset of the position from that tap's centre, in [0, 1).
  bvec4 accepted;  // Which taps are accepted, in the order of `historyTap`.
};
const bvec4 kAllTaps = bvec4(true);

int tapsRejected(HistoryTaps taps) { return 4 - int(dot(vec4(taps.accepted), vec4(1.0))); }

// The position itself, in pixels from the centre of the first pixel.
vec2 tapPosition(HistoryTaps taps) { return vec2(taps.base) + taps.fraction; }

ivec2 tapOffset(int i) { return ivec2(i & 1, i >> 1); }
ivec2 historyTap(HistoryTaps taps, int i) { return taps.base + tapOffset(i); }

// Which taps lie inside an image of the given size. As unsigned numbers, negative coordinates are above any size.
bvec4 tapsInside(HistoryTaps taps, ivec2 size) {
  const bvec2 first = lessThan(uvec2(taps.base), uvec2(size)), second = lessThan(uvec2(taps.base + 1), uvec2(size));
  return bvec4(first.x && first.y, second.x && first.y, first.x && second.y, second.x && second.y);
}

// The corner that the four taps share, in texture coordinates of an image whose texels have the size `texel` in them.
// `textureGather` would only choose other texels half a pixel away, so that rounding does not matter.
vec2 sharedCorner(HistoryTaps taps, vec2 texel) { return (vec2(taps.base) + 1.0) * texel; }

// The texels of the taps in an image of one channel, in the order of `historyTap`. Outside of it, texels of its border.
uvec4 gatherTaps(usampler2D image, vec2 corner) { return textureGather(image, corner).wzxy; }

// LIGHT_GRID_TAPS: a history may lie on the light grid (light_sample.glsl), so that its size is not that of the frame.
#ifdef PACKED
#ifdef LIGHT_GRID_TAPS
vec2 historyTexelSize(usampler2D history) { return 1.0 / vec2(textureSize(history, 0)); }
#else
vec2 historyTexelSize(usampler2D history) { return frame.previousTexel; }
#endif
#endif

// The texels of the taps in a history. All are fetched at once, accepted or not, so that their latencies overlap.
#ifdef PACKED
// A sum of weight times colour over texels is in units of kUnit.
const float kUnit = 1.0 / float(1 << kExponentBias + kHistoryBits);
void addColour(inout vec3 sum, float weight, uint texel) {
  // Adding the texel's exponent to the weight's own multiplies them. A weight of 0 stays next to 0.
  const float scaled = uintBitsToFloat(floatBitsToUint(weight) + (exponentBits(texel, kHistoryBits) << 23));
  sum += scaled * mantissasOf(texel, kHistoryBits);
}
// The length is in the highest bits.
bool hasLength(uint texel) { return texel >= 1u << 3 * kHistoryBits + 5; }

#define TAP_TEXELS uvec4
uvec4 tapTexels(usampler2D history, HistoryTaps taps) {
  return gatherTaps(history, sharedCorner(taps, historyTexelSize(history)));
}
#else
#define TAP_TEXELS vec4[4]
vec4[4] tapTexels(texture2D history, HistoryTaps taps) {
  const ivec2 last = textureSize(history, 0) - 1;
  vec4 texels[4];
  for (int i = 0; i < 4; ++i) texels[i] = historyTexel(history, clamp(historyTap(taps, i), ivec2(0), last));
  return texels;
}
#endif

// Bilinear weights of the accepted taps; 0 for the others.
vec4 tapWeights(HistoryTaps taps) {
  const vec2 f = taps.fraction, g = 1.0 - taps.fraction;
  const vec4 bilinear = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  return mix(vec4(0.0), bilinear, taps.accepted);
}

// If the weights sum to less, the taps tell next to nothing about the position between them.
const float kLeastTapWeight = 0.01;

// COUNT_EMPTY_TAPS: whether taps without history count as of length 0 in the mean of lengths. With sparse light, a
// sample would otherwise spread to the empty pixels around it and count in each of them.
#ifndef COUNT_EMPTY_TAPS
#define COUNT_EMPTY_TAPS false
#endif

// Factor of a mean length over the taps with history.
// `known`: sum of their weights; `bilinear`: weights of all accepted taps.
float shareOfKnownTaps(float known, vec4 bilinear) {
  return COUNT_EMPTY_TAPS ? known / max(dot(bilinear, vec4(1.0)), kLeastTapWeight) : 1.0;
}

// Bilinear mean of the accepted taps that have a history; 0 if there is none. Alpha is the history length: a pixel of
// length 0 is without light, not black, and does not count.
vec4 meanOfTaps(HISTORY_TEXTURE history, HistoryTaps taps) {
  const vec4 bilinear = tapWeights(taps);
  const TAP_TEXELS texels = tapTexels(history, taps);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int i = 0; i < 4; ++i) {
#ifdef PACKED
    const float weight = hasLength(texels[i]) ? bilinear[i] : 0.0;
    addColour(sum.rgb, weight, texels[i]);
    sum.a += weight * unpackHistoryLength(texels[i]);
#else
    const vec4 texel = texels[i];
    const float weight = texel.a > 0.0 ? bilinear[i] : 0.0;
    // Light without history may be infinite in half precision, and 0 times infinity is NaN.
    sum += texel.a > 0.0 ? weight * texel : vec4(0.0);
#endif
    weights += weight;
  }
  // An infinite divisor makes the mean 0. A product with 1 / weights would be cheaper than the division, but it rounds:
  // the mean of equal taps would differ from them, and antilag would take that for a change of light without noise.
  const float divisor = weights > kLeastTapWeight ? weights : uintBitsToFloat(0x7f800000u);
  vec4 mean = sum / divisor;
  mean.a *= shareOfKnownTaps(weights, bilinear);
#ifdef PACKED
  return vec4(kUnit * mean.rgb, mean.a);
#else
  return mean;
#endif
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
  const vec2 rounded = uintBitsToFloat((bits + 0x3fffu + bitfieldExtract(bits, 15, 1)) & ~0x7fffu);
  return mix(rounded, vec2(0.0), lessThan(abs(motion), vec2(6.103515625e-5)));
}

// The history taps of pixel `p`, none of them accepted yet. The previous frame may have another size (see
// FrameConstants). `precise`, so that stages that keep taps and stages that read them never round to different sides of
// a pixel's centre.
HistoryTaps tapsAround(ivec2 p, vec2 motion, vec2 previousPixelFromPixel) {
  precise const vec2 moved = vec2(p) + 0.5 + motion;
  precise const vec2 position = fma(moved, previousPixelFromPixel, vec2(-0.5));
  const vec2 base = floor(position);
  return HistoryTaps(ivec2(base), position - base, bvec4(false));
}

// The accept bits of the four taps in a texel.
const uvec4 kAcceptBits = uvec4(1u, 2u, 1u << 16, 1u << 17);

// `motion`: a result of keepableMotion.
uint packTaps(vec2 motion, bvec4 accepted) {
  const uvec4 bits = mix(uvec4(0u), kAcceptBits, accepted);
  return (packHalf2x16(motion) & kMotionBits) | bits.x | bits.y | bits.z | bits.w;
}

// `kept`: texel of a pixel with a surface.
HistoryTaps unpackTaps(ivec2 p, uint kept, vec2 previousPixelFromPixel) {
  HistoryTaps taps = tapsAround(p, unpackHalf2x16(kept & kMotionBits), previousPixelFromPixel);
  taps.accepted = notEqual(kept & kAcceptBits, uvec4(0u));
  return taps;
}

#endif
