// Packed light: a colour in 32 bits, as three mantissas under a shared exponent. The bits that are left hold a history
// length.
// Running means are rounded stochastically, up or down at random such that the expected value is exact up to 1/512 of a
// step: rounded to nearest, a mean would stop where a new sample moves it by less than half a step. The pass-through is
// no mean and is rounded to nearest.
#ifndef WALR_PACKED_LIGHT_GLSL
#define WALR_PACKED_LIGHT_GLSL
#include "conventions/packed_light.h"
#include "common/hash.glsl"

// Seeds of the random numbers, one for each running mean.
const uint kAccumulatedSeed = 0x100u, kResolvedSeed = 0x102u;

// Four random numbers for every pixel, frame and seed: (i + 0.5) / 256 with a uniform i in 0 .. 255.
vec4 randomNumbers(ivec2 p, uint frameIndex, uint seed) {
  const uint bits = hashOfPixel(uvec2(p), frameIndex, seed);
  return vec4(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u, bits >> 24) / 256.0 + 0.5 / 256.0;
}

// A number in [0, 1) for light that is no running mean: low discrepancy over neighbouring pixels (R2; Roberts 2018) and
// over the frames of a pixel, and a third of the work of random numbers.
float ditherNumber(ivec2 p, uint frameIndex) {
  const float ofFrame = float(frameIndex * 0x9e3779b9u) * exp2(-32.0);
  return fract(float(p.x) * 0.7548776662 + (float(p.y) * 0.5698402910 + ofFrame));
}

// Stochastic rounding of `x`, at least 0 and below 2^9, to one of the two integers around it. Its mean over uniform
// `random` in (0, 1) is `x`; a `random` of 0.5 rounds to nearest.
uint roundStochastically(float x, float random) { return uint(x + random); }
uvec3 roundStochastically(vec3 x, vec3 random) { return uvec3(x + random); }

float powerOfTwo(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }

// The exponent of a positive normal number: the largest n with 2^n <= x.
int exponentOf(float x) { return int(floatBitsToUint(x) >> 23) - 127; }

// Three mantissas of `bits` bits without an implicit leading one, and above them the 5-bit exponent: channels are
// multiples of 2^(exponent - 15 - bits).
const int kExponentBias = 15;
const int kLargestExponent = 31;

float largestPacked(int bits) { return (powerOfTwo(bits) - 1.0) * powerOfTwo(kLargestExponent - kExponentBias - bits); }

// `c`: from 0 to largestPacked.
uint packClamped(vec3 c, int bits, vec3 random) {
  const int finest = kExponentBias + bits;
  const float brightest = max(max(c.r, c.g), max(c.b, powerOfTwo(-kExponentBias - 1)));
  // Above 2^bits - 1 steps, rounding up might need one bit more. The sum then carries into the exponent.
  const float needed = uintBitsToFloat(floatBitsToUint(brightest) + ((1u << 24 - bits) - 1u));
  const int exponent = exponentOf(needed) + kExponentBias + 1;
  const uvec3 mantissas = roundStochastically(c * powerOfTwo(finest - exponent), random);
  return mantissas.r | mantissas.g << bits | mantissas.b << 2 * bits | uint(exponent) << 3 * bits;
}

uint packColour(vec3 colour, int bits, vec3 random) {
  return packClamped(clamp(colour, vec3(0.0), vec3(largestPacked(bits))), bits, random);
}

vec3 mantissasOf(uint packed, int bits) {
  return vec3(bitfieldExtract(packed, 0, bits), bitfieldExtract(packed, bits, bits),
              bitfieldExtract(packed, 2 * bits, bits));
}
uint exponentBits(uint packed, int bits) { return bitfieldExtract(packed, 3 * bits, 5); }

vec3 unpackColour(uint packed, int bits) {
  return mantissasOf(packed, bits) * powerOfTwo(int(exponentBits(packed, bits)) - kExponentBias - bits);
}

// A history length from 0 to 480 in six bits: in steps of 0.5 below 8, above of 1/16 to 1/8 of its value.
uint packCount(float count, float random) {
  const int exponent = exponentOf(max(count, 4.0)) - 2;
  return 8u * uint(exponent) + roundStochastically(count * powerOfTwo(1 - exponent), random);
}

// From 8 on, the bits are the exponent, less its bias, and the first three bits of the mantissa of a float. Below, that
// float is 2 + packed / 4, half as far from 4 as the length.
float unpackCount(uint packed) {
  const float x = uintBitsToFloat((packed + 8u * 128u) << 20);
  return min(x, 2.0 * x - 4.0);
}

// What a packed length needs to know of the longest one.
struct PackedLength {
  float longest;      // The longest history length, frames.
  bool beyondLevels;  // It is above 64. If not, the highest level needs no test, because 2^6 is no shorter.
};

// A history length in three bits, as one of the levels 0, 1, 2, 4, 8, 16, 32 and the longest length; levels above it
// count as it. Rounding between levels is stochastic: a mean that stays at a level for some frames weighs new frames by
// more than its true length would, and is then as precise as a mean of twice that length. `level`: at least 1.
float unpackLength(uint level, PackedLength most) {
  const bool beyond = most.beyondLevels && int(level) == kLongestLevel;
  return beyond ? most.longest : min(powerOfTwo(int(level) - 1), most.longest);
}

// `length`: at least 1.
uint packLength(float length, PackedLength most, float random) {
  const float capped = most.beyondLevels ? min(length, powerOfTwo(kLongestLevel - 2)) : length;
  const float low = uintBitsToFloat(floatBitsToUint(capped) & 0xff800000u);
  const uint level = uint(exponentOf(capped) + 1);
  const float high = most.beyondLevels ? unpackLength(level + 1u, most) : min(2.0 * low, most.longest);
  const uint rounded = level + (random * (high - low) < length - low ? 1u : 0u);
  return length >= most.longest ? uint(kLongestLevel) : rounded;
}

// Accumulated light (temporal_accumulation.comp): mean in 3 x 7 bits, and its history length in alpha.
const int kAccumulatedBits = 7;
uint packAccumulated(vec4 mean, vec4 random) {
  return packColour(mean.rgb, kAccumulatedBits, random.rgb) | packCount(mean.a, random.a) << 26;
}
vec4 unpackAccumulated(uint packed) {
  return vec4(unpackColour(packed, kAccumulatedBits), unpackCount(packed >> 26));
}

// Filtered light, which every surface has: 3 x 9 bits. `colour`: at most 65408.
uint packFiltered(vec3 colour, float dither) { return packClamped(colour, 9, vec3(dither)); }

// Mark of a pixel without a surface: an exponent with all mantissas 0, which no packed colour has.
const uint kFilteredNoSurface = 1u << 27;

// Alpha: below 0 where there is no surface.
vec4 unpackFiltered(uint packed) { return vec4(unpackColour(packed, 9), packed == kFilteredNoSurface ? -1.0 : 1.0); }

// Pass-through: 3 x 9 bits, rounded to nearest, so that constant light does not flicker. The error is at most 1/511 of
// the brightest channel. Values are clamped to 0 to 65408.
uint packPassThrough(vec3 colour) { return packColour(colour, 9, vec3(0.5)); }
vec3 unpackPassThrough(uint packed) { return unpackColour(packed, 9); }

// Anti-aliased light (temporal_antialiasing.comp): mean in 3 x 8 bits, and its history length in alpha, at most
// `most.longest`. `mean`: from 0 to largestPacked.
const int kResolvedBits = 8;
uint packResolved(vec4 mean, PackedLength most, vec4 random) {
  return packClamped(mean.rgb, kResolvedBits, random.rgb) | packLength(mean.a, most, random.a) << 29;
}
vec4 unpackResolved(uint packed, PackedLength most) {
  const uint level = packed >> 29;
  return vec4(unpackColour(packed, kResolvedBits), level == 0u ? 0.0 : unpackLength(level, most));
}

#endif
