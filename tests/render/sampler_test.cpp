// Checks the properties that the constructions of the samplers guarantee.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "samples/render/sampler.h"
#include "tests/render/statistics.h"

namespace walr::render {
namespace {

constexpr std::uint32_t kSeed = 7;
constexpr std::uint32_t kDimensions = 5;

std::uint32_t pixelAt(std::uint32_t x, std::uint32_t y) {
  return (y << 16U) | x;
}

// The number of cells of a grid that 64 points occupy.
template <typename PointOf>
std::size_t cells(float columns, float rows, PointOf pointOf) {
  std::set<std::pair<int, int>> seen;
  for (std::uint32_t i = 0; i < 64; ++i) {
    const glm::vec2 point = pointOf(i);
    EXPECT_TRUE(point.x >= 0.0F && point.x < 1.0F && point.y >= 0.0F && point.y < 1.0F);
    seen.emplace(static_cast<int>(point.x * columns), static_cast<int>(point.y * rows));
  }
  return seen.size();
}

// Any 64 points of a (0, 2)-sequence from a multiple of 64 on have one point in every cell of every grid of 64 equal
// cells.
template <typename PointOf>
void expectNet(PointOf pointOf) {
  for (const auto& [columns, rows] : {std::pair(8.0F, 8.0F), {64.0F, 1.0F}, {1.0F, 64.0F}, {16.0F, 4.0F}}) {
    EXPECT_EQ(cells(columns, rows, pointOf), 64U) << columns << " x " << rows;
  }
}

glm::vec2 point(Sampler::Kind kind, std::uint32_t pixel, std::uint32_t index, std::uint32_t dimension) {
  Sampler sampler(kind, kSeed, pixel, index);
  for (std::uint32_t i = 0; i < dimension; ++i) {
    sampler.next2D();
  }
  return sampler.next2D();
}

TEST(Sampler, SobolPointsOfAPixelAreANet) {
  for (std::uint32_t dimension = 0; dimension < kDimensions; ++dimension) {
    expectNet([&](std::uint32_t i) { return point(Sampler::Kind::Sobol, pixelAt(3, 5), 64 + i, dimension); });
  }
}

TEST(Sampler, BlueNoisePointsOfABlockOfPixelsAreANet) {
  for (std::uint32_t dimension = 0; dimension < kDimensions; ++dimension) {
    for (const std::uint32_t frame : {0U, 9U}) {
      expectNet([&](std::uint32_t i) {
        return point(Sampler::Kind::BlueNoise, pixelAt(8 + i % 8, 640 + i / 8), frame, dimension);
      });
    }
  }
}

TEST(Sampler, FramesAndSeedsDiffer) {
  for (const Sampler::Kind kind : {Sampler::Kind::Sobol, Sampler::Kind::BlueNoise, Sampler::Kind::Independent}) {
    std::set<float> seen;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
      for (std::uint32_t frame = 0; frame < 8; ++frame) {
        seen.insert(Sampler(kind, seed, pixelAt(1, 2), frame).next1D());
      }
    }
    EXPECT_GT(seen.size(), 60U);
  }
}

// The numbers of a pixel over frames are uniform: their mean and the mean of their squares are those of uniform
// numbers.
TEST(Sampler, EveryPixelIsUniformOverFrames) {
  for (const Sampler::Kind kind : {Sampler::Kind::Sobol, Sampler::Kind::BlueNoise, Sampler::Kind::Independent}) {
    test::Statistics value;
    test::Statistics square;
    for (std::uint32_t frame = 0; frame < 4096; ++frame) {
      const glm::vec2 taken = point(kind, pixelAt(100, 50), frame, 2);
      value.add(taken.x);
      square.add(taken.y * taken.y);
    }
    EXPECT_NEAR(value.mean(), 0.5, test::kConfidence * value.standardError());
    EXPECT_NEAR(square.mean(), 1.0 / 3.0, test::kConfidence * square.standardError());
  }
}

}  // namespace
}  // namespace walr::render
