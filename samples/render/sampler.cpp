#include "samples/render/sampler.h"

namespace walr::render {
namespace {

// A bijection of 32 bits that mixes all of them (constants: C. Wellons' search, "lowbias32").
std::uint32_t mixBits(std::uint32_t x) {
  x ^= x >> 16U;
  x *= 0x7feb352dU;
  x ^= x >> 15U;
  x *= 0x846ca68bU;
  x ^= x >> 16U;
  return x;
}

std::uint32_t combine(std::uint32_t a, std::uint32_t b) {
  return mixBits(a ^ (b * 0x9e3779b9U + 0x7f4a7c15U));
}

std::uint32_t reverseBits(std::uint32_t x) {
  x = ((x & 0x55555555U) << 1U) | ((x >> 1U) & 0x55555555U);
  x = ((x & 0x33333333U) << 2U) | ((x >> 2U) & 0x33333333U);
  x = ((x & 0x0f0f0f0fU) << 4U) | ((x >> 4U) & 0x0f0f0f0fU);
  x = ((x & 0x00ff00ffU) << 8U) | ((x >> 8U) & 0x00ff00ffU);
  return (x << 16U) | (x >> 16U);
}

// Burley 2020, section 3.2: a permutation in which every bit depends only on the bits below it (Laine and Karras
// 2011), so that between two bit reversals it is an Owen scramble.
std::uint32_t owenScramble(std::uint32_t x, std::uint32_t seed) {
  x = reverseBits(x);
  x += seed;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return reverseBits(x);
}

// Second dimension of the Sobol sequence, whose generator matrix is Pascal's triangle modulo 2.
std::uint32_t sobolSecond(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t column = 0x80000000U; index != 0; index >>= 1U, column ^= column >> 1U) {
    result ^= (index & 1U) != 0 ? column : 0U;
  }
  return result;
}

// The upper 24 bits: every value is exact in float and below 1.
float toUnit(std::uint32_t x) {
  return static_cast<float>(x >> 8U) * 0x1p-24F;
}

}  // namespace

Sampler::Sampler(Kind kind, std::uint32_t seed, std::uint32_t pixel, std::uint32_t index)
    : kind_(kind), sequence_(combine(mixBits(seed), pixel)), index_(index) {}

glm::vec2 Sampler::next2D() {
  const std::uint32_t seed = combine(sequence_, dimension_++);
  if (kind_ == Kind::Independent) {
    const std::uint32_t x = combine(seed, index_);
    return {toUnit(x), toUnit(combine(x, 1U))};
  }
  const std::uint32_t shuffled = owenScramble(index_, seed);
  return {toUnit(owenScramble(reverseBits(shuffled), combine(seed, 1U))),
          toUnit(owenScramble(sobolSecond(shuffled), combine(seed, 2U)))};
}

}  // namespace walr::render
