// Reads a history texture with a bicubic filter (Keys 1981).
// PACKED: needs `kHistoryBits`, the mantissa bits of the history (packed_light.glsl), and `unpackHistoryLength`, for
// lengths above 0.
#ifndef WALR_BICUBIC_GLSL
#define WALR_BICUBIC_GLSL
#include "temporal/history_taps.glsl"

// Weights of the four pixels around a position, which lies `f` pixels past the second, and their sums over the first
// two and the last two. `sharpness` is -a of Keys 1981, equation 4: how far the outer weights fall below 0.
struct CubicWeights {
  vec4 each;
  vec2 halves;
};
const float kCatmullRom = 0.5;  // The sharpness whose error is of the third order.
CubicWeights cubicWeights(float f, float sharpness) {
  const float g = 1.0 - f, product = f * g, a = sharpness * product;
  const float first = (product - a) * (1.0 - 2.0 * f) + g, last = 1.0 - first;
  return CubicWeights(vec4(-a * g, a * g + first, a * f + last, -a * f), vec2(first, last));
}

// The 4 x 4 texels around a position, row by row; outside of the image, texels of its border.
#ifdef PACKED
#define TEXEL uint
uint[16] texelsAround(usampler2D history, HistoryTaps taps) {
  const vec2 texel = historyTexelSize(history), first = vec2(taps.base) * texel;
  uint texels[16];
  [[unroll]] for (int j = 0; j < 4; j += 2) {
    [[unroll]] for (int i = 0; i < 4; i += 2) {
      const uvec4 quad = textureGather(history, first + vec2(i, j) * texel);  // Around this corner.
      texels[4 * j + i] = quad.w;
      texels[4 * j + i + 1] = quad.z;
      texels[4 * j + i + 4] = quad.x;
      texels[4 * j + i + 5] = quad.y;
    }
  }
  return texels;
}
uint shorter(uint a, uint b) { return min(a, b); }
float lengthOf(uint texel) { return unpackHistoryLength(texel); }
uint finiteTexel(uint texel) { return texel; }
#else
#define TEXEL vec4
const float kUnit = 1.0;
vec4[16] texelsAround(texture2D history, HistoryTaps taps) {
  const ivec2 last = textureSize(history, 0) - 1;
  vec4 texels[16];
  [[unroll]] for (int k = 0; k < 16; ++k)
    texels[k] = texelFetch(history, clamp(taps.base + ivec2(k & 3, k >> 2) - 1, ivec2(0), last), 0);
  return texels;
}
void addColour(inout vec3 sum, float weight, vec4 texel) { sum += weight * texel.rgb; }
bool hasLength(vec4 texel) { return texel.a > 0.0; }
vec4 shorter(vec4 a, vec4 b) { return vec4(min(a.a, b.a)); }
float lengthOf(vec4 texel) { return texel.a; }
// The light of a texel without history may be infinite in half precision, and 0 times infinity is NaN.
vec4 finiteTexel(vec4 texel) { return hasLength(texel) ? texel : vec4(0.0); }
#endif

// Mean radiance and history length at the position of the history taps. Radiance is bicubic if all four history taps
// are accepted and each of the eight pixels beside them has history. Sky has none (length 0), and the filter would ring
// its light into the surface. Otherwise radiance is the mean of the accepted taps. Alpha, the history length, is their
// mean in both cases.
// The bicubic filter takes the four corners of the 4 x 4 pixels, whose weights sum to sharpness^2 / 16 at most, from the plane
// through the three pixels next to them.
vec4 bicubicOfTaps(HISTORY_TEXTURE history, HistoryTaps taps, float sharpness) {
  const TEXEL t[16] = texelsAround(history, taps);
  const TEXEL inner[4] = TEXEL[4](t[5], t[6], t[9], t[10]);
  const TEXEL beside[8] = TEXEL[8](t[1], t[2], t[4], t[7], t[8], t[11], t[13], t[14]);

  const CubicWeights alongX = cubicWeights(taps.fraction.x, sharpness);
  const CubicWeights alongY = cubicWeights(taps.fraction.y, sharpness);
  const vec4 x = alongX.each, y = alongY.each;
  const vec4 cubicInner = x.yzyz * y.yyzz - x.xwxw * y.xxww;
  const vec2 columns = alongX.halves, rows = alongY.halves;
  const float cubicBeside[8] = float[8](columns[0] * y.x, columns[1] * y.x, rows[0] * x.x, rows[0] * x.w,
                                        rows[1] * x.x, rows[1] * x.w, columns[0] * y.w, columns[1] * y.w);
  vec3 colour = vec3(0.0);
  TEXEL shortest = beside[0];
  for (int i = 0; i < 8; ++i) {
    addColour(colour, cubicBeside[i], beside[i]);
    shortest = shorter(shortest, beside[i]);
  }
  for (int i = 0; i < 4; ++i) shortest = shorter(shortest, inner[i]);
  const bool bicubic = taps.accepted == kAllTaps && hasLength(shortest);

  const vec4 bilinear = tapWeights(taps);
  vec4 weights = bilinear;
  for (int i = 0; i < 4; ++i) weights[i] = hasLength(inner[i]) ? weights[i] : 0.0;
  const float sum = dot(weights, vec4(1.0));
  weights *= sum > kLeastTapWeight ? 1.0 / sum : 0.0;
  float frames = 0.0;
  for (int i = 0; i < 4; ++i) frames += weights[i] * lengthOf(inner[i]);
  frames *= shareOfKnownTaps(sum, bilinear);
  if (!bicubic) colour = vec3(0.0);
  for (int i = 0; i < 4; ++i) addColour(colour, bicubic ? cubicInner[i] : weights[i], finiteTexel(inner[i]));
  return vec4(max(colour, vec3(0.0)) * kUnit, frames);
}

#endif
