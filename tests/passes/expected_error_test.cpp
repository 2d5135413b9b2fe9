// The expected error of a result, against the formula of passes/EXPECTED_ERROR.md, in double precision.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>

#include "passes/stage/expected_error.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"

namespace walr::test::expected_error_test {
namespace {

using reference::forEachPixel;
using reference::Image;

constexpr glm::ivec2 kSize(27, 19);  // Tiles that end outside.
constexpr int kTile = 8;

/// A tile of 8 x 8 pixels and some pixels have no light.
bool isLit(glm::ivec2 p) {
  return (p.x >= kTile || p.y >= kTile) && (p.x * 7 + p.y * 5) % 11 != 0;
}

double luminanceOf(const glm::dvec4& light) {
  return 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b;
}

/// Contrast of the result around a pixel, times the mean of what accumulated light says beside it.
double productAt(const Image<glm::dvec4>& accumulated, const Image<glm::dvec4>& result, glm::ivec2 centre) {
  std::vector<double> mapped, residuals;
  for (int y = std::max(centre.y - 1, 0); y <= std::min(centre.y + 1, kSize.y - 1); ++y) {
    for (int x = std::max(centre.x - 1, 0); x <= std::min(centre.x + 1, kSize.x - 1); ++x) {
      if (!isLit({x, y})) continue;
      const double light = luminanceOf(result[{x, y}]);
      mapped.push_back(light / (1.0 + light));
      residuals.push_back((luminanceOf(accumulated[{x, y}]) - light) / ((1.0 + light) * (1.0 + light)));
    }
  }
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / double(values.size());
  };
  double variance = 0.0;
  for (const double value : mapped) variance += std::pow(value - mean(mapped), 2.0) / double(mapped.size());
  return std::sqrt(variance) * std::abs(mean(residuals));
}

double expectedAt(const Image<glm::dvec4>& accumulated, const Image<glm::dvec4>& result, glm::ivec2 p) {
  const glm::ivec2 first = p / kTile * kTile;
  double sum = 0.0, pixels = 0.0;
  forEachPixel(kSize, [&](glm::ivec2 q) {
    if (q / kTile * kTile != first || !isLit(q)) return;
    sum += productAt(accumulated, result, q);
    pixels += 1.0;
  });
  return pixels > 0.0 ? std::sqrt(0.028 / std::pow(kSize.y, 1.5) + sum / pixels) : 0.0;
}

class ExpectedError : public fg::test::GpuTest {};

TEST_F(ExpectedError, AgreesWithTheFormula) {
  std::mt19937 random(1);
  std::vector<std::uint32_t> accumulated;
  std::vector<std::uint16_t> result;
  forEachPixel(kSize, [&](glm::ivec2 p) {
    // Three mantissas of 7 bits under an exponent of 5 bits; above them a history length of 2 or 0.
    accumulated.push_back(random() % (1U << 21U) | (8 + random() % 10) << 21U | (isLit(p) ? 4U << 26U : 0U));
    for (int c = 0; c < 3; ++c)  // 2^-9 to 2^4: exponents of halves are biased by 15.
      result.push_back(std::uint16_t((6 + random() % 14) << 10U | random() % 1024));
    result.push_back(0);
  });

  const fg::Extent extent{std::uint32_t(kSize.x), std::uint32_t(kSize.y)};
  fg::Graph graph;
  const fg::Texture mean = graph.import("accumulated", {VK_FORMAT_R32_UINT, extent}, fg::vk::kUploaded);
  const fg::Texture denoised = graph.import("result", {VK_FORMAT_R16G16B16A16_SFLOAT, extent}, fg::vk::kUploaded);
  Inspection inspection;
  inspection.wantExpectedError(graph.import("expected error", {kExpectedErrorFormat, extent}, fg::vk::kOverwritable));
  inspection.want("expected-error", graph.import("view", {kViewFormat, extent}, fg::vk::kOverwritable));
  const StageGraph stages(graph, inspection);
  offerExpectedError(stages, mean, denoised);
  stages.requireOutputs();
  const fg::Texture viewed = inspection.views().front().texture;
  for (const fg::Texture output : {inspection.expectedError(), viewed}) graph.exported(output, fg::vk::kReadable);
  fg::test::GraphRun run(device(), graph, {.shared = device().pipelines()});
  run.fill(mean, accumulated);
  run.fill(denoised, result);
  run.frame();
  const std::vector<std::uint16_t> halves = run.texels<std::uint16_t>(inspection.expectedError());
  const std::vector<float> view = run.texels<float>(viewed);

  const Image<glm::dvec4> accumulatedLight = decodeAccumulated(accumulated, kSize), light = decodeHalves(result, kSize);
  // Sums over 9 and 64 numbers in single precision have some hundred roundings. Image stores round halves up or down.
  constexpr double kFloats = 300.0 * reference::kFloatRoundoff, kHalf = 2.0 * reference::kHalfRoundoff;
  forEachPixel(kSize, [&](glm::ivec2 p) {
    SCOPED_TRACE(std::to_string(p.x) + ", " + std::to_string(p.y));
    const std::size_t i = std::size_t(p.y) * kSize.x + p.x;
    const double expected = expectedAt(accumulatedLight, light, p);
    ASSERT_NEAR(glm::unpackHalf1x16(halves[i]), expected, (kHalf + kFloats) * expected);
    ASSERT_NEAR(view[4 * i], isLit(p) ? expected : 0.0, kFloats * expected);
    const double product = isLit(p) ? productAt(accumulatedLight, light, p) : 0.0;
    ASSERT_NEAR(view[4 * i + 1] * view[4 * i + 2], product, kFloats);
  });
  EXPECT_EQ(halves[0], 0);                              // No light in the tile.
  EXPECT_GT(glm::unpackHalf1x16(halves[11]), 0.0183F);  // sqrt(0.028 / 19^1.5) is 0.01839.
}

}  // namespace
}  // namespace walr::test::expected_error_test
