#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/reference/storage.h"

namespace walr::reference::reference_storage_test {
namespace {

TEST(Storage, HalvesRoundToNearestEven) {
  EXPECT_EQ(roundToHalf(0.0), 0.0);
  EXPECT_EQ(roundToHalf(1.0 / 3.0), 0.333251953125);
  EXPECT_EQ(roundToHalf(1.0 + 0x1p-11), 1.0);           // A tie: 1 is even.
  EXPECT_EQ(roundToHalf(1.0 + 0x3p-11), 1.0 + 0x1p-9);  // A tie: the upper one is even.
  EXPECT_EQ(roundToHalf(-65519.0), -65504.0);
  EXPECT_TRUE(std::isinf(roundToHalf(65520.0)));
  EXPECT_EQ(roundToFiniteHalf(1e30), 65504.0);
  EXPECT_EQ(roundToHalf(0x1p-25), 0.0);  // A tie between 0 and the smallest half.
  EXPECT_EQ(roundToHalf(0x3p-25), 0x1p-23);
  for (double x = 6.2e-5; x < 6e4; x *= 1.0137) EXPECT_LE(std::abs(roundToHalf(x) - x), kHalfRoundoff * x) << x;
}

TEST(Storage, UnsignedFloatsHaveTheLimitsOfTheirFormat) {
  EXPECT_EQ(roundToUnsignedFloat(1e9, 6), 65024.0);
  EXPECT_EQ(roundToUnsignedFloat(1e9, 5), 64512.0);
  EXPECT_EQ(roundToUnsignedFloat(-0.5, 6), 0.0);
  EXPECT_EQ(roundToUnsignedFloat(0x1p-20, 6), 0x1p-20);
  EXPECT_EQ(roundToUnsignedFloat(0x1p-22, 6), 0.0);
  for (double x = 6.2e-5; x < 6e4; x *= 1.0137) {
    EXPECT_LE(std::abs(roundToUnsignedFloat(x, 6) - x), kFloat11Roundoff * x) << x;
    EXPECT_LE(std::abs(roundToUnsignedFloat(x, 5) - x), kFloat10Roundoff * x) << x;
  }
}

TEST(Storage, DepthKeepsNineteenBits) {
  for (double z = 1e-3; z < 1e9; z *= 1.0731) {
    const double rounded = roundDepth(z);
    EXPECT_LE(std::abs(rounded - z), kDepthRoundoff * z);
    EXPECT_EQ(roundDepth(rounded), rounded);
    EXPECT_EQ(double(static_cast<float>(rounded)), rounded);
  }
}

TEST(Storage, UnormsSpanTheUnitInterval) {
  EXPECT_EQ(roundToUnorm16(-1.0), 0.0);
  EXPECT_EQ(roundToUnorm16(1.5), 1.0);
  EXPECT_NEAR(roundToUnorm16(0.5), 0.5, 0.5 * kUnorm16Step);
}

/// Directions all over the sphere, none of them exactly on a seam of the octahedral map.
template <typename Visit>
void forEachDirection(Visit visit) {
  for (double polar = 0.01; polar < 3.1; polar += 0.07)
    for (double azimuth = 0.003; azimuth < 6.28; azimuth += 0.11)
      visit(glm::dvec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
}

TEST(Octahedral, DecodeInvertsEncode) {
  forEachDirection([](glm::dvec3 n) {
    const glm::dvec2 uv = octahedralEncode(n);
    EXPECT_TRUE(uv.x >= 0.0 && uv.x <= 1.0 && uv.y >= 0.0 && uv.y <= 1.0);
    EXPECT_LE(glm::length(octahedralDecode(uv) - n), 1e-14);
  });
}

// Half a step in [0, 1] is a step s in [-1, 1]. x and y move by s and z by 2 s, together by sqrt(6) s, on an octahedron
// that is nowhere nearer to the origin than 1 / sqrt(3).
TEST(Octahedral, SixteenBitsKeepTheDirection) {
  const double bound = std::sqrt(18.0) * kUnorm16Step;
  forEachDirection([&](glm::dvec3 n) {
    const glm::dvec2 uv = octahedralEncode(n);
    const glm::dvec3 decoded = octahedralDecode({roundToUnorm16(uv.x), roundToUnorm16(uv.y)});
    EXPECT_LE(glm::length(decoded - n), bound);
  });
}

// Half a step on both axes; the inverse projection lengthens by 2 at most.
TEST(ShortNormal, KeepsTheDirectionTo5DegreesAndTheViewAxis) {
  const double bound = 2.0 * std::sqrt(0.5) * kShortNormalStep;
  ASSERT_LT(bound, glm::radians(5.1));
  forEachDirection([&](glm::dvec3 n) {
    if (n.z < std::cos(glm::radians(125.0))) return;
    EXPECT_LE(glm::length(roundToShortNormal(n) - n), bound);
  });
  EXPECT_EQ(roundToShortNormal({0.0, 0.0, 1.0}), glm::dvec3(0.0, 0.0, 1.0));
}

// Normals on the two sides of n.z = 0 have neighbouring features.
TEST(Octahedral, FoldIsContinuous) {
  constexpr double kStep = 1e-9;
  for (double azimuth = 0.01; azimuth < 6.28; azimuth += 0.1) {
    const glm::dvec3 flat(std::cos(azimuth), std::sin(azimuth), 0.0);
    const glm::dvec2 above = octahedralEncode(glm::normalize(flat + glm::dvec3(0.0, 0.0, kStep)));
    const glm::dvec2 below = octahedralEncode(glm::normalize(flat - glm::dvec3(0.0, 0.0, kStep)));
    EXPECT_LE(glm::length(above - below), 4.0 * kStep);
  }
}

TEST(Hash, PicksEveryStepAboutEquallyOften) {
  constexpr int kKeys = 30000;
  constexpr std::uint32_t kSteps = 27;
  std::vector<int> counts(kSteps);
  for (std::uint32_t i = 0; i < kKeys; ++i) ++counts.at(hashBelow({i % 173, i / 173, 7, 31}, kSteps));
  // Five standard deviations of a binomial count.
  const double mean = double(kKeys) / kSteps;
  for (const int count : counts) EXPECT_NEAR(count, mean, 5.0 * std::sqrt(mean));
}

TEST(Hash, EveryWordOfTheKeyMatters) {
  const glm::uvec4 key(12, 34, 56, 78);
  std::set<std::uint32_t> values{pcg4d(key).x};
  for (int i = 0; i < 4; ++i) {
    glm::uvec4 other = key;
    ++other[i];
    values.insert(pcg4d(other).x);
  }
  EXPECT_EQ(values.size(), 5U);
}

}  // namespace
}  // namespace walr::reference::reference_storage_test
