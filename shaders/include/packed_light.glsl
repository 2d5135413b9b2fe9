// Packed light: a colour in 32 bits, as three mantissas under a shared exponent. The bits that are left hold a history
// length.
// Running means are rounded stochastically, up or down at random such that the expected value is exact: rounded to
// nearest, a mean would stop where a new sample moves it by less than half a step. The pass-through is no mean and is
// rounded to nearest.
#ifndef WALR_PACKED_LIGHT_GLSL
#define WALR_PACKED_LIGHT_GLSL
#include "hash.glsl"

// Seeds of the random numbers, one for each texture that is rounded.
const uint kAccumulatedSeed = 0x100u, kFilteredSeed = 0x101u, kResolvedSeed = 0x102u;

// Four uniform random numbers in [0, 1), different for every pixel, frame and seed.
vec4 randomNumbers(ivec2 p, uint frameIndex, uint key) {
  return vec4(pcg4d(uvec4(p, frameIndex, key)) >> 8) / 16777216.0;
}

// Stochastic rounding to one of the two integers around `x`; its mean over uniform `random` in [0, 1) is `x`.
float roundStochastically(float x, float random) { return floor(x) + (random < fract(x) ? 1.0 : 0.0); }
vec3 roundStochastically(vec3 x, vec3 random) { return floor(x) + vec3(lessThan(random, fract(x))); }

float powerOfTwo(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }

// Three mantissas of `bits` bits without an implicit leading one, and above them the 5-bit exponent: channels are
// multiples of 2^(exponent - 15 - bits).
const int kExponentBias = 15;
const int kLargestExponent = 31;

uint packColour(vec3 colour, int bits, vec3 random) {
  const float largest = powerOfTwo(bits) - 1.0;
  const int finest = kExponentBias + bits;
  const vec3 c = clamp(colour, vec3(0.0), vec3(largest * powerOfTwo(kLargestExponent - finest)));
  const float brightest = max(max(c.r, c.g), c.b);
  int exponent = max(int(floatBitsToUint(brightest) >> 23) - 126 + kExponentBias, 0);
  if (brightest * powerOfTwo(finest - exponent) > largest) ++exponent;  // Rounding up might need one bit more.
  const uvec3 mantissas = uvec3(roundStochastically(c * powerOfTwo(finest - exponent), random));
  return mantissas.r | mantissas.g << bits | mantissas.b << 2 * bits | uint(exponent) << 3 * bits;
}

vec3 unpackColour(uint packed, int bits) {
  const uvec3 mantissas = uvec3(packed, packed >> bits, packed >> 2 * bits) & ((1u << bits) - 1u);
  const int exponent = int(packed >> 3 * bits) & kLargestExponent;
  return vec3(mantissas) * powerOfTwo(exponent - kExponentBias - bits);
}

// A history length from 0 to 480 in six bits: in steps of 0.5 below 8, above of 1/16 to 1/8 of its value.
uint packCount(float count, float random) {
  const float halves = 2.0 * count;
  const int exponent = max(int(floatBitsToUint(halves) >> 23) - 127 - 3, 0);
  return 8u * uint(exponent) + uint(roundStochastically(halves * powerOfTwo(-exponent), random));
}

float unpackCount(uint packed) {
  const int exponent = max(int(packed >> 3) - 1, 0);
  return 0.5 * powerOfTwo(exponent) * float(packed - 8u * uint(exponent));
}

// A history length in three bits, as one of the levels 0, 1, 2, 4, 8, 16, 32 and `longest`; levels above `longest`
// count as `longest`. Rounding between levels is stochastic: a mean that stays at a level for some frames weighs new
// frames by more than its true length would, and is then as precise as a mean of twice that length.
const uint kLongestLevel = 7u;

float unpackLength(uint level, float longest) {
  if (level == 0u) return 0.0;
  return level == kLongestLevel ? longest : min(powerOfTwo(int(level) - 1), longest);
}

// `length`: 0, or at least 1.
uint packLength(float length, float longest, float random) {
  if (length == 0.0) return 0u;
  if (length >= longest) return kLongestLevel;
  const uint level = min(uint(floatBitsToUint(length) >> 23) - 126u, kLongestLevel - 1u);
  const float low = unpackLength(level, longest), high = unpackLength(level + 1u, longest);
  return level + (random * (high - low) < length - low ? 1u : 0u);
}

// Accumulated light (temporal_accumulation.comp): mean in 3 x 7 bits, and its history length in alpha.
uint packAccumulated(vec4 mean, vec4 random) {
  return packColour(mean.rgb, 7, random.rgb) | packCount(mean.a, random.a) << 26;
}
vec4 unpackAccumulated(uint packed) { return vec4(unpackColour(packed, 7), unpackCount(packed >> 26)); }

// Filtered light, which every surface has: 3 x 9 bits.
uint packFiltered(vec3 colour, vec3 random) { return packColour(colour, 9, random); }

// Mark of a pixel without a surface: an exponent with all mantissas 0, which no packed colour has.
const uint kFilteredNoSurface = 1u << 27;

// Alpha: below 0 where there is no surface.
vec4 unpackFiltered(uint packed) { return vec4(unpackColour(packed, 9), packed == kFilteredNoSurface ? -1.0 : 1.0); }

// Pass-through: 3 x 9 bits, rounded to nearest, so that constant light does not flicker. The error is at most 1/511 of
// the brightest channel. Values are clamped to 0 to 65408.
uint packPassThrough(vec3 colour) { return packColour(colour, 9, vec3(0.5)); }
vec3 unpackPassThrough(uint packed) { return unpackColour(packed, 9); }

// Anti-aliased light (temporal_antialiasing.comp): mean in 3 x 8 bits, and its history length in alpha, at most
// `longest`.
uint packResolved(vec4 mean, float longest, vec4 random) {
  return packColour(mean.rgb, 8, random.rgb) | packLength(mean.a, longest, random.a) << 29;
}
vec4 unpackResolved(uint packed, float longest) {
  return vec4(unpackColour(packed, 8), unpackLength(packed >> 29, longest));
}

#endif
