#include "samples/render/sampler.h"

#include <algorithm>
#include <array>

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

// A permutation in which every bit depends only on the bits below it (Laine and Karras 2011). Between two bit reversals
// it is an Owen scramble (Burley 2020, 3.2).
std::uint32_t laineKarras(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return x;
}

std::uint32_t owenScramble(std::uint32_t x, std::uint32_t seed) {
  return reverseBits(laineKarras(reverseBits(x), seed));
}

// The bits of the Sobol sequence's second dimension in reverse order. Its generator matrix is Pascal's triangle modulo
// 2, the fifth Kronecker power of a matrix of 2 x 2, so that five steps multiply by it (Ahmed 2024).
std::uint32_t reversedSobolSecond(std::uint32_t index) {
  index ^= (index >> 16U) & 0x0000ffffU;
  index ^= (index >> 8U) & 0x00ff00ffU;
  index ^= (index >> 4U) & 0x0f0f0f0fU;
  index ^= (index >> 2U) & 0x33333333U;
  index ^= (index >> 1U) & 0x55555555U;
  return index;
}

// Inserts a zero bit above each of the lower 16 bits.
std::uint32_t spreadBits(std::uint32_t x) {
  x &= 0x0000ffffU;
  x = (x | (x << 8U)) & 0x00ff00ffU;
  x = (x | (x << 4U)) & 0x0f0f0f0fU;
  x = (x | (x << 2U)) & 0x33333333U;
  return (x | (x << 1U)) & 0x55555555U;
}

// The 24 permutations of four quadrants, each as four numbers of two bits, the first in the lowest bits.
constexpr auto kOrders = [] {
  std::array<std::uint8_t, 24> orders{};
  std::array<unsigned int, 4> order = {0, 1, 2, 3};
  for (std::uint8_t& packed : orders) {
    packed = static_cast<std::uint8_t>(order[0] | order[1] << 2U | order[2] << 4U | order[3] << 6U);
    std::next_permutation(order.begin(), order.end());
  }
  return orders;
}();

// Position on a Z-order curve whose four quadrants are shuffled independently within every quadrant of every level.
std::uint32_t shuffledZOrder(std::uint32_t place, std::uint32_t seed) {
  constexpr std::uint32_t kLevels = 14;  // Enough for images of up to 16384 pixels a side.
  std::uint32_t shuffled = 0;
  for (std::uint32_t level = 0; level < kLevels; ++level) {
    const std::uint32_t shift = 2 * level;
    // The leading one distinguishes the quadrants of different levels.
    const std::uint32_t quadrant = (place | 1U << 2 * kLevels) >> (shift + 2);
    const std::uint32_t order = kOrders.at(combine(seed, quadrant) % kOrders.size());
    shuffled |= (order >> 2 * (place >> shift & 3U) & 3U) << shift;
  }
  return shuffled;
}

// Uses the upper 24 bits, so that every value is exact in float and below 1.
float toUnit(std::uint32_t x) {
  return static_cast<float>(x >> 8U) * 0x1p-24F;
}

// A point of the Sobol sequence; its two dimensions are Owen-scrambled independently. The first dimension is the
// reversed index, so that the scramble's own reversal restores the index.
glm::vec2 sobolPoint(std::uint32_t index, std::uint32_t seed) {
  return {toUnit(reverseBits(laineKarras(index, combine(seed, 1U)))),
          toUnit(reverseBits(laineKarras(reversedSobolSecond(index), combine(seed, 2U))))};
}

}  // namespace

Sampler::Sampler(Kind kind, std::uint32_t seed, std::uint32_t pixel, std::uint32_t index)
    : kind_(kind),
      seed_(mixBits(seed)),
      place_(spreadBits(pixel) | spreadBits(pixel >> 16U) << 1U),
      sequence_(combine(seed_, pixel)),
      index_(index) {}

glm::vec2 Sampler::sharedPoint(std::uint32_t seed) const {
  return sobolPoint(shuffledZOrder(place_, combine(seed, 3U)), seed);
}

glm::vec2 Sampler::next2D() {
  if (kind_ == Kind::BlueNoise) {
    return sharedPoint(combine(combine(seed_, index_), dimension_++));
  }
  const std::uint32_t seed = combine(sequence_, dimension_++);
  if (kind_ == Kind::Independent) {
    const std::uint32_t x = combine(seed, index_);
    return {toUnit(x), toUnit(combine(x, 1U))};
  }
  return sobolPoint(owenScramble(index_, seed), seed);
}

}  // namespace walr::render
