// Storage of moments between two iterations. kMomentStorage, one of four, chooses the format:
//   kCentred16  means and covariances as halves, with the sample count and the root of the mean squared luminance
//   kRaw16      raw moments as halves (Meunier & Harada 2022, 5.2, RGBA16_FLOAT)
//   kRaw11      raw moments as unsigned 11- and 10-bit floats (Meunier & Harada 2022, 5.2, R11G11B10_FLOAT)
//   kRaw32      raw moments in single precision, to study the effect of storage alone
// Shaders that write moments need a macro of that name in capitals, such as CENTRED16, because it also decides the
// formats of images. With LAST they are only read, and a specialization constant chooses.
// Raw formats hold averages of products and, like the paper, no sample count. Both mean features are 0 where a pixel
// has no sample: no normal that faces the camera lies in that corner of the octahedral map.
// Takes constant_id 9.
#ifndef WALR_MOMENTS_STORAGE_GLSL
#define WALR_MOMENTS_STORAGE_GLSL
#include "common/half.glsl"
#include "regression/moments.glsl"

const uint kCentred16 = 0u, kRaw16 = 1u, kRaw11 = 2u, kRaw32 = 3u;  // MomentStorage.
#ifdef LAST
layout(constant_id = 9) const uint kMomentStorage = kCentred16;
#define MOMENT_TEXTURES 4  // Of all storages.
#elif defined(CENTRED16)
const uint kMomentStorage = kCentred16;
#define MOMENT_TEXTURES 2
#define MOMENT_FORMAT_B rgba32ui
#elif defined(RAW16)
const uint kMomentStorage = kRaw16;
#define MOMENT_TEXTURES 3
#define MOMENT_FORMAT_B rg32ui
#define MOMENT_FORMAT_C r32ui
#elif defined(RAW11)
const uint kMomentStorage = kRaw11;
#define MOMENT_TEXTURES 2
#define MOMENT_FORMAT_B r32ui
#elif defined(RAW32)
const uint kMomentStorage = kRaw32;
#define MOMENT_TEXTURES 4
#define MOMENT_FORMAT_B rgba32ui
#define MOMENT_FORMAT_C rgba32ui
#define MOMENT_FORMAT_D rg32ui
#endif

#ifndef FIRST
uniform utexture2D momentsA;
uniform utexture2D momentsB;
#if MOMENT_TEXTURES > 2
uniform utexture2D momentsC;
#endif
#if MOMENT_TEXTURES > 3
uniform utexture2D momentsD;
#endif
#endif
#ifndef LAST
layout(rgba32ui) uniform writeonly uimage2D outMomentsA;
layout(MOMENT_FORMAT_B) uniform writeonly uimage2D outMomentsB;
#if MOMENT_TEXTURES > 2
layout(MOMENT_FORMAT_C) uniform writeonly uimage2D outMomentsC;
#endif
#if MOMENT_TEXTURES > 3
layout(MOMENT_FORMAT_D) uniform writeonly uimage2D outMomentsD;
#endif
#endif

struct PackedMoments {
  uvec4 a, b, c, d;
};

PackedMoments packCentred(Moments m) {
  PackedMoments p;
  p.a = uvec4(packHalves(m.x.x, m.x.y), packHalves(m.y.r, m.y.g), packHalves(m.y.b, m.xx.x),
              packHalves(m.xx.y, m.xx.z));
  // The mean squared luminance itself would overflow a half from a luminance of 256 on.
  p.b = uvec4(packHalves(m.yu.r, m.yu.g), packHalves(m.yu.b, m.yv.r), packHalves(m.yv.g, m.yv.b),
              packHalves(sqrt(m.luma2), m.samples));
  return p;
}

Moments unpackCentred(PackedMoments p) {
  const vec2 a0 = unpackHalf2x16(p.a.x), a1 = unpackHalf2x16(p.a.y), a2 = unpackHalf2x16(p.a.z),
             a3 = unpackHalf2x16(p.a.w);
  const vec2 b0 = unpackHalf2x16(p.b.x), b1 = unpackHalf2x16(p.b.y), b2 = unpackHalf2x16(p.b.z),
             b3 = unpackHalf2x16(p.b.w);
  return Moments(a0, vec3(a1, a2.x), vec3(a2.y, a3), vec3(b0, b1.x), vec3(b1.y, b2), b3.x * b3.x, b3.y);
}

// Unsigned floats with a 5-bit exponent and `mantissaBits` of mantissa, rounded to nearest: truncation would darken by
// 3 % and shift the hue.
uint packUnsignedFloat(float x, int mantissaBits) {
  const int drop = 23 - mantissaBits;
  const uint largest = (30u << mantissaBits) | ((1u << mantissaBits) - 1u);
  if (!(x > 0.0)) return 0u;
  if (x < 6.103515625e-5) return uint(roundEven(x * exp2(float(14 + mantissaBits))));  // Subnormal.
  const uint rounded = floatBitsToUint(x) + (1u << (drop - 1)) - 1u + ((floatBitsToUint(x) >> drop) & 1u);
  return min((rounded >> drop) - (112u << mantissaBits), largest);
}
float unpackUnsignedFloat(uint x, int mantissaBits) {
  const uint exponent = x >> mantissaBits;
  const uint mantissa = x & ((1u << mantissaBits) - 1u);
  return exponent == 0u ? float(mantissa) * exp2(float(-14 - mantissaBits))
                        : uintBitsToFloat(((exponent + 112u) << 23) | (mantissa << (23 - mantissaBits)));
}
uint packTriple(vec3 v) {
  return packUnsignedFloat(v.x, 6) | (packUnsignedFloat(v.y, 6) << 11) | (packUnsignedFloat(v.z, 5) << 22);
}
vec3 unpackTriple(uint v) {
  return vec3(unpackUnsignedFloat(v & 0x7ffu, 6), unpackUnsignedFloat((v >> 11) & 0x7ffu, 6),
              unpackUnsignedFloat(v >> 22, 5));
}

// The fourteen raw moments: averages of X, XX, Y and YX.
struct RawMoments {
  vec2 x;
  vec3 xx;
  vec3 y, yu, yv;
};

PackedMoments packRaw16(RawMoments r) {
  PackedMoments p;
  const vec3 limit = vec3(kLargestHalf);
  r.y = min(r.y, limit);
  r.yu = min(r.yu, limit);
  r.yv = min(r.yv, limit);
  p.a = uvec4(packHalf2x16(r.x), packHalf2x16(r.xx.xy), packHalf2x16(vec2(r.xx.z, r.y.r)), packHalf2x16(r.y.gb));
  p.b = uvec4(packHalf2x16(r.yu.rg), packHalf2x16(vec2(r.yu.b, r.yv.r)), 0u, 0u);
  p.c = uvec4(packHalf2x16(r.yv.gb), 0u, 0u, 0u);
  return p;
}

RawMoments unpackRaw16(PackedMoments p) {
  RawMoments r;
  const vec2 a1 = unpackHalf2x16(p.a.y), a2 = unpackHalf2x16(p.a.z), b1 = unpackHalf2x16(p.b.y);
  r.x = unpackHalf2x16(p.a.x);
  r.xx = vec3(a1, a2.x);
  r.y = vec3(a2.y, unpackHalf2x16(p.a.w));
  r.yu = vec3(unpackHalf2x16(p.b.x), b1.x);
  r.yv = vec3(b1.y, unpackHalf2x16(p.c.x));
  return r;
}

PackedMoments packRaw11(RawMoments r) {
  PackedMoments p;
  p.a = uvec4(packTriple(r.y), packTriple(r.yu), packTriple(r.yv), packTriple(r.xx));
  p.b = uvec4(packTriple(vec3(r.x, 0.0)), 0u, 0u, 0u);
  return p;
}

RawMoments unpackRaw11(PackedMoments p) {
  return RawMoments(unpackTriple(p.b.x).xy, unpackTriple(p.a.w), unpackTriple(p.a.x), unpackTriple(p.a.y),
                    unpackTriple(p.a.z));
}

PackedMoments packRaw32(RawMoments r) {
  PackedMoments p;
  p.a = floatBitsToUint(vec4(r.x, r.xx.xy));
  p.b = floatBitsToUint(vec4(r.xx.z, r.y));
  p.c = floatBitsToUint(vec4(r.yu, r.yv.r));
  p.d = uvec4(floatBitsToUint(r.yv.gb), 0u, 0u);
  return p;
}

RawMoments unpackRaw32(PackedMoments p) {
  RawMoments r;
  r.x = uintBitsToFloat(p.a.xy);
  r.xx = uintBitsToFloat(uvec3(p.a.zw, p.b.x));
  r.y = uintBitsToFloat(p.b.yzw);
  r.yu = uintBitsToFloat(p.c.xyz);
  r.yv = uintBitsToFloat(uvec3(p.c.w, p.d.xy));
  return r;
}

PackedMoments packMoments(Moments m) {
  if (kMomentStorage == kCentred16) return packCentred(m);
  RawMoments r;
  r.x = m.x;
  r.xx = m.xx + vec3(m.x.x * m.x.x, m.x.x * m.x.y, m.x.y * m.x.y);
  r.y = m.y;
  r.yu = m.yu + m.y * m.x.x;
  r.yv = m.yv + m.y * m.x.y;
  if (kMomentStorage == kRaw16) return packRaw16(r);
  if (kMomentStorage == kRaw11) return packRaw11(r);
  return packRaw32(r);
}

RawMoments unpackRaw(PackedMoments p) {
  if (kMomentStorage == kRaw16) return unpackRaw16(p);
  if (kMomentStorage == kRaw11) return unpackRaw11(p);
  return unpackRaw32(p);
}

Moments unpackMoments(PackedMoments p) {
  if (kMomentStorage == kCentred16) return unpackCentred(p);
  const RawMoments r = unpackRaw(p);
  Moments m;
  m.x = r.x;
  m.y = r.y;
  m.xx = r.xx - vec3(r.x.x * r.x.x, r.x.x * r.x.y, r.x.y * r.x.y);
  m.yu = r.yu - r.y * r.x.x;
  m.yv = r.yv - r.y * r.x.y;
  m.luma2 = 0.0;
  m.samples = r.x == vec2(0.0) ? 0.0 : 1.0;
  return m;
}

// Where a pixel has no surface, its texel holds the pass-through instead of moments, so that the last iteration need
// not read the input.
#ifdef FIRST
uvec2 packedPassThrough(ivec2 p) {
  const vec3 light = passThroughLight(accumulated, p);
  return uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, 0.0)));
}
#else
uvec2 packedPassThrough(ivec2 p) { return texelFetch(momentsA, p, 0).xy; }

Moments loadMoments(ivec2 p) {
  PackedMoments packed;
  packed.a = texelFetch(momentsA, p, 0);
  packed.b = texelFetch(momentsB, p, 0);
#if MOMENT_TEXTURES > 2
  if (kMomentStorage == kRaw16 || kMomentStorage == kRaw32) packed.c = texelFetch(momentsC, p, 0);
#endif
#if MOMENT_TEXTURES > 3
  if (kMomentStorage == kRaw32) packed.d = texelFetch(momentsD, p, 0);
#endif
  return unpackMoments(packed);
}
#endif

#ifndef LAST
void storePacked(ivec2 p, PackedMoments packed) {
  imageStore(outMomentsA, p, packed.a);
  imageStore(outMomentsB, p, packed.b);
#if MOMENT_TEXTURES > 2
  imageStore(outMomentsC, p, packed.c);
#endif
#if MOMENT_TEXTURES > 3
  imageStore(outMomentsD, p, packed.d);
#endif
}
void storeMoments(ivec2 p, Moments m) { storePacked(p, packMoments(m)); }
void storeNoMoments(ivec2 p) { storePacked(p, PackedMoments(uvec4(0u), uvec4(0u), uvec4(0u), uvec4(0u))); }
void storePassThrough(ivec2 p) {
  storePacked(p, PackedMoments(uvec4(packedPassThrough(p), 0u, 0u), uvec4(0u), uvec4(0u), uvec4(0u)));
}
#endif

#endif
