// The length of history that follows the correlation of innovations (passes/WALR.md, 9): against a calculation in
// double precision.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "passes/temporal/antilag.h"
#include "shaders/temporal/antilag.h"
#include "tests/passes/block_filter.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::steered_history_test {
namespace {

using reference::Image;

constexpr glm::ivec2 kSize(53, 37);  // Not a multiple of the tiles.
constexpr std::uint32_t kBlock = 4;
constexpr int kTile = 8;    // Pixels per axis of a tile of the statistics: two blocks.
constexpr int kBefore = 2;  // Pixels of the first tile before the image: half a block.
constexpr double kSamples = 8.0;
constexpr double kLongest = 8.0;
const glm::ivec2 kTiles = (kSize - 1 + kBefore) / kTile + 1;
const glm::ivec2 kAntilagTiles = (kSize - 1) / kAntilagTile + 1;

/// A frame's light and its mean with the history, whose innovations are `factor` times those of the first frame.
/// Stripes that no guide shows make both agree, so that the agreement is trusted.
struct Light {
  explicit Light(double factor) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      // The bilinear history of innovations ends at the border of the image: there are none to be missed.
      const bool border = p.x == 0 || p.y == 0 || p.x == kSize.x - 1 || p.y == kSize.y - 1;
      const double innovation = noise(random) * (border ? 0.0 : factor);
      const double h = 1.0 + (p.x / 2 % 2 == 0 ? 0.5 : -0.5);
      lighting[p] = glm::dvec4(glm::dvec3(reference::roundToHalf(h + innovation)), 1.0);
      mean[p] = glm::dvec4(glm::dvec3(reference::roundToHalf(h + innovation / kSamples)), kSamples);
    });
  }
  /// Luminance of this frame's light less that of the history, from the values that the device reads.
  [[nodiscard]] double innovation(glm::ivec2 p) const {
    return kSamples / (kSamples - 1.0) *
           (reference::luminance(glm::dvec3(lighting[p])) - reference::luminance(glm::dvec3(mean[p])));
  }
  Image<glm::dvec4> lighting{kSize}, mean{kSize};
};

/// The filter without a share of accumulated light, whose result is the prediction, or with it. The result is then the
/// least antilag factor of each tile.
FilterRun filterRun(const fg::test::TestDevice& device, bool steers) {
  const auto add = [steers](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
    BlockLight light{.accumulated = inputs[0], .alpha = LightingAlpha::SampleCount, .lighting = inputs[1]};
    if (steers) light.history = declareSteeredHistory(graph, graph.textureDesc(inputs[0]).extent, float(kLongest));
    BlockRegressionSettings settings{.size = kBlock, .iterations = 2, .coarseSigma = 0.15F};
    settings.share.enabled = steers;
    const fg::Texture filtered = addBlockFilter(graph, frame, light, guides, settings);
    if (!steers) return filtered;
    fg::Texture factor = light.history->leastAntilag.current;
    ++factor.version;  // That which the filter writes.
    return factor;
  };
  return {device, kSize, 2, add, true};
}

/// Slope of the regression of a frame's innovations on those of the frame before, around a tile of the statistics.
double slopeAround(glm::ivec2 middle, const Light& before, const Light& now, const Image<glm::dvec4>& predicted) {
  Image<glm::dvec2> sums(kTiles), lights(kTiles);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::ivec2 tile = (p + kBefore) / kTile;
    const double previous = reference::roundToHalf(before.innovation(p));
    sums[tile] += previous * glm::dvec2(now.innovation(p), previous);
    lights[tile] += glm::dvec2(reference::luminance(glm::dvec3(predicted[p])), 1.0);
  });
  glm::dvec2 sum(0.0);
  const int radius = int(AccumulatedShareSettings{}.radius);
  reference::forEachPixel(kTiles, [&](glm::ivec2 t) {
    if (std::max(std::abs(t.x - middle.x), std::abs(t.y - middle.y)) > radius) return;
    sum += lights[t].y / lights[t].x * sums[t];
  });
  return sum.x / sum.y;
}

class SteeredHistoryTest : public fg::test::GpuTest {};

TEST_F(SteeredHistoryTest, AgreesWithDoublePrecision) {
  FilterRun steered = filterRun(device(), true), fits = filterRun(device(), false);
  const reference::HostFrame frame = renderStill(flatWall(), kSize);
  const Image<reference::Guide> guides =
      reference::prepareGuides(frame, reference::Storage::Quantised, {}, kOcclusionInSmallImages);
  // Innovations that agree shorten history, and those that contradict each other lengthen it, up to the longest.
  const std::array factors{1.0, 0.2, 0.04, -0.02, 0.01, 0.01};
  const AccumulatedShareSettings settings;
  Image<double> frames(kAntilagTiles, kLongest + 1.0);
  Light before(0.0);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    const bool first = i == 0;
    const Light now(factors.at(i));
    const Image<glm::dvec4> predicted = fits.run(frame, guides, {now.mean, now.lighting});
    const Image<glm::dvec4> actual = steered.run(frame, guides, {now.mean, now.lighting});
    reference::forEachPixel(kAntilagTiles, [&](glm::ivec2 tile) {
      const glm::ivec2 middle = glm::min((kAntilagTile * tile + kAntilagTile / 2 + kBefore) / kTile, kTiles - 1);
      const double slope = first ? 0.0 : slopeAround(middle, before, now, predicted);
      const double excess = slope + 0.5 * settings.innovationBias / kLongest;
      // Nothing is trusted before there are statistics.
      const double change = settings.innovationGain * (excess > 0.0 && first ? 0.0 : excess);
      frames[tile] = std::clamp(frames[tile] * (1.0 - change), 2.0, kLongest);
      // The previous innovation is a half, read bilinearly at a position that rounding moves by less than 2^-12 of a
      // pixel, where the neighbours' innovations are up to twice as large. The result is copied as a half.
      const double ofSlope = settings.innovationGain * std::abs(slope) * (std::exp2(-11.0) + 4.0 * std::exp2(-12.0));
      EXPECT_NEAR(actual[tile].x, 1.0 - (frames[tile] - 1.0) / kLongest,
                  ofSlope * (kLongest + 1.0) / kLongest + std::exp2(-11.0))
          << tile.x << ", " << tile.y;
      frames[tile] = kLongest * (1.0 - actual[tile].x) + 1.0;
    });
    before = now;
  }
}

}  // namespace
}  // namespace walr::test::steered_history_test
