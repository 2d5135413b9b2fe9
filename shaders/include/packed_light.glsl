// Light in 32 bits: three mantissas under a shared exponent and, above them, how many samples or frames are behind it.
// Rounding is unbiased, that is, up or down by random such that the mean is exact: a running mean that were rounded to
// nearest would stop where a new sample moves it by less than half a step. What passes through no mean is rounded to
// nearest.
#ifndef WALR_PACKED_LIGHT_GLSL
#define WALR_PACKED_LIGHT_GLSL
#include "hash.glsl"

// Keys of the random by which each texture is rounded.
const uint kAccumulatedSeed = 0x100u, kFilteredSeed = 0x101u, kResolvedSeed = 0x102u;

// Uniform in [0, 1), others in every pixel, frame and texture.
vec4 randomNumbers(ivec2 p, uint frameIndex, uint key) {
  return vec4(pcg4d(uvec4(p, frameIndex, key)) >> 8) / 16777216.0;
}

// Of the two whole numbers around `x` one whose mean over `random` is `x`.
float roundStochastically(float x, float random) { return floor(x) + (random < fract(x) ? 1.0 : 0.0); }
vec3 roundStochastically(vec3 x, vec3 random) { return floor(x) + vec3(lessThan(random, fract(x))); }

float powerOfTwo(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }

// Mantissas of `bits` bits without a leading one, the exponent's five above them: multiples of 2^(exponent - 15 - bits).
const int kExponentBias = 15;
const int kLargestExponent = 31;

uint packColour(vec3 colour, int bits, vec3 random) {
  const float largest = powerOfTwo(bits) - 1.0;
  const int finest = kExponentBias + bits;
  const vec3 c = clamp(colour, vec3(0.0), vec3(largest * powerOfTwo(kLargestExponent - finest)));
  const float brightest = max(max(c.r, c.g), c.b);
  int exponent = max(int(floatBitsToUint(brightest) >> 23) - 126 + kExponentBias, 0);
  if (brightest * powerOfTwo(finest - exponent) > largest) ++exponent;  // Might round up to one bit more.
  const uvec3 mantissas = uvec3(roundStochastically(c * powerOfTwo(finest - exponent), random));
  return mantissas.r | mantissas.g << bits | mantissas.b << 2 * bits | uint(exponent) << 3 * bits;
}

vec3 unpackColour(uint packed, int bits) {
  const uvec3 mantissas = uvec3(packed, packed >> bits, packed >> 2 * bits) & ((1u << bits) - 1u);
  const int exponent = int(packed >> 3 * bits) & kLargestExponent;
  return vec3(mantissas) * powerOfTwo(exponent - kExponentBias - bits);
}

// A count from 0 to 480 in six bits: steps of a half below 8, of a sixteenth to an eighth of the count above.
uint packCount(float count, float random) {
  const float halves = 2.0 * count;
  const int exponent = max(int(floatBitsToUint(halves) >> 23) - 127 - 3, 0);
  return 8u * uint(exponent) + uint(roundStochastically(halves * powerOfTwo(-exponent), random));
}

float unpackCount(uint packed) {
  const int exponent = max(int(packed >> 3) - 1, 0);
  return 0.5 * powerOfTwo(exponent) * float(packed - 8u * uint(exponent));
}

// A length in three bits: 0, 1, 2, 4, 8, 16, 32 and `longest`, none of them above it. A mean whose length lingers at one
// of these weighs new frames by more than its age would have it, and knows its value as well as it would at twice that
// length.
const uint kLongestLevel = 7u;

float unpackLength(uint level, float longest) {
  if (level == 0u) return 0.0;
  return level == kLongestLevel ? longest : min(powerOfTwo(int(level) - 1), longest);
}

// Of a length that is 0 or at least 1.
uint packLength(float length, float longest, float random) {
  if (length == 0.0) return 0u;
  if (length >= longest) return kLongestLevel;
  const uint level = min(uint(floatBitsToUint(length) >> 23) - 126u, kLongestLevel - 1u);
  const float low = unpackLength(level, longest), high = unpackLength(level + 1u, longest);
  return level + (random * (high - low) < length - low ? 1u : 0u);
}

// Mean over time with the samples behind it (temporal_accumulation.comp). rgb: 3 x 7 bits.
uint packAccumulated(vec4 mean, vec4 random) {
  return packColour(mean.rgb, 7, random.rgb) | packCount(mean.a, random.a) << 26;
}
vec4 unpackAccumulated(uint packed) { return vec4(unpackColour(packed, 7), unpackCount(packed >> 26)); }

// What a spatial filter makes of it, where that is known of every surface: 3 x 9 bits.
uint packFiltered(vec3 colour, vec3 random) { return packColour(colour, 9, random); }

// Where there is no surface: an exponent with no mantissa under it, which no colour has.
const uint kFilteredNoSurface = 1u << 27;

// a: below 0 where there is no surface.
vec4 unpackFiltered(uint packed) { return vec4(unpackColour(packed, 9), packed == kFilteredNoSurface ? -1.0 : 1.0); }

// What passes through a pixel without a surface, rounded to nearest lest it flicker where it stays the same: 3 x 9 bits,
// off by at most 1/511 of the brightest channel. What is below 0 becomes 0, what is above 65408 that.
uint packPassThrough(vec3 colour) { return packColour(colour, 9, vec3(0.5)); }
vec3 unpackPassThrough(uint packed) { return unpackColour(packed, 9); }

// Mean of such pictures with the frames behind it, at most `longest` (temporal_antialiasing.comp). rgb: 3 x 8 bits.
uint packResolved(vec4 mean, float longest, vec4 random) {
  return packColour(mean.rgb, 8, random.rgb) | packLength(mean.a, longest, random.a) << 29;
}
vec4 unpackResolved(uint packed, float longest) {
  return vec4(unpackColour(packed, 8), unpackLength(packed >> 29, longest));
}

#endif
