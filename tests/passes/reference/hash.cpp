#include "tests/passes/reference/hash.h"

namespace walr::reference {
namespace {

/// Add to every word the product of two others, one word after the other.
void mix(std::uint32_t (&word)[4]) {
  constexpr int kFactors[4][2] = {{1, 3}, {2, 0}, {0, 1}, {1, 2}};
  for (int i = 0; i < 4; ++i) word[i] += word[kFactors[i][0]] * word[kFactors[i][1]];
}

}  // namespace

glm::uvec4 pcg4d(glm::uvec4 key) {
  std::uint32_t word[4] = {key.x, key.y, key.z, key.w};
  for (std::uint32_t& w : word) w = w * 1664525U + 1013904223U;
  mix(word);
  for (std::uint32_t& w : word) w ^= w >> 16U;
  mix(word);
  return {word[0], word[1], word[2], word[3]};
}

std::uint32_t hashBelow(glm::uvec4 key, std::uint32_t count) {
  return static_cast<std::uint32_t>((std::uint64_t{pcg4d(key).x} * count) >> 32U);
}

}  // namespace walr::reference
