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

constexpr glm::ivec2 kSize(45, 37);  // Not a multiple of the tiles.
constexpr std::uint32_t kBlock = 4;
constexpr int kTile = 8;    // Pixels per axis of a tile of the statistics: two blocks.
constexpr int kBefore = 2;  // Pixels of the first tile before the image: half a block.
constexpr double kSamples = 8.0;
const glm::ivec2 kQuads = (kSize - 1) / 2 + 1;
const glm::ivec2 kTiles = (kSize - 1 + kBefore) / kTile + 1;
const glm::ivec2 kAntilagTiles = (kSize - 1) / kAntilagTile + 1;

/// A frame's light and its mean with the history, whose innovations are `factor` times those of the first frame.
/// Stripes that no guide shows make both agree, so that the agreement is trusted.
struct Light {
  explicit Light(double factor) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      // The bilinear history of innovations ends at the quads of the image's border: there are none to be missed.
      const glm::ivec2 quad = p / 2;
      const bool border = quad.x == 0 || quad.y == 0 || quad.x == kQuads.x - 1 || quad.y == kQuads.y - 1;
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
  /// Of a quad, all pixels of which lie in one tile: their number, and the sums of their innovations and of the
  /// squares.
  [[nodiscard]] glm::dvec3 quad(glm::ivec2 quad) const {
    glm::dvec3 sums(0.0);
    for (const glm::ivec2 offset : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
      const glm::ivec2 p = 2 * quad + offset;
      if (p.x < kSize.x && p.y < kSize.y) sums += glm::dvec3(1.0, innovation(p), innovation(p) * innovation(p));
    }
    return sums;
  }
  Image<glm::dvec4> lighting{kSize}, mean{kSize};
};

/// Nearest float with three significant bits, which is what a stored innovation keeps of a half.
double roundInnovation(double value) {
  const double step = value == 0.0 ? 1.0 : std::exp2(std::floor(std::log2(std::abs(value))) - 2.0);
  return step * std::round(value / step);
}

/// The filter without a share of accumulated light, whose result is the prediction, or with it. The result is then the
/// least antilag factor of each tile.
/// @param longest history, frames
FilterRun filterRun(const fg::test::TestDevice& device, bool steers, double longest) {
  const auto add = [steers, longest](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
    BlockLight light{.accumulated = inputs[0], .alpha = LightingAlpha::SampleCount, .lighting = inputs[1]};
    if (steers) light.history = declareSteeredHistory(graph, graph.textureDesc(inputs[0]).extent, float(longest));
    BlockRegressionSettings settings{.size = kBlock, .iterations = 2, .coarseSigma = 0.15F};
    settings.share.enabled = steers;
    const fg::Texture filtered = addBlockFilter(graph, frame, light, guides, settings);
    if (!steers) return filtered;
    fg::Texture factor = light.history->limits.current;
    ++factor.version;  // That which the filter writes.
    return factor;
  };
  return {device, kSize, 2, add, true};
}

/// Slope of the regression of a frame's innovations on those of the frame before, around a tile of the statistics.
double slopeAround(glm::ivec2 middle, const Light& before, const Light& now, const Image<glm::dvec4>& predicted) {
  Image<glm::dvec2> sums(kTiles), lights(kTiles);
  reference::forEachPixel(kQuads, [&](glm::ivec2 quad) {
    const glm::dvec3 last = before.quad(quad), current = now.quad(quad);
    const double previous = roundInnovation(last.y / last.x);
    if (previous != 0.0) sums[(2 * quad + kBefore) / kTile] += glm::dvec2(previous * current.y, current.z);
  });
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::ivec2 tile = (p + kBefore) / kTile;
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

void expectAgreement(const fg::test::TestDevice& device, double longest) {
  FilterRun steered = filterRun(device, true, longest), fits = filterRun(device, false, longest);
  const reference::HostFrame frame = renderStill(flatWall(), kSize);
  const Image<reference::Guide> guides =
      reference::prepareGuides(frame, reference::Storage::Quantised, {}, kOcclusionInSmallImages);
  // Innovations that agree shorten history, and those that contradict each other lengthen it, up to the longest.
  const std::array factors{0.4, 1.0, 0.2, 0.04, -0.02, 0.01};
  const AccumulatedShareSettings settings;
  Image<double> frames(kAntilagTiles, longest + 1.0);
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
      // Of the pixels' slope, half of the share of a frame, quads are to lack .82.
      const double ofPixels = first ? 0.0 : 0.82 * 0.5 / frames[tile];
      const double excess = slope - ofPixels + 0.5 * settings.innovationBias / longest;
      // Nothing is trusted before there are statistics. Then the share is 1 within 2^-9: the stripes' square of .25
      // counts eightfold against the noise of the mean, less than .03 / 8.
      // The gain is full up to histories of 8 frames.
      const double gain = settings.innovationGain * (first ? 1.0 : 9.0) * std::min(8.0 / frames[tile], 1.0);
      const double change = gain * (excess > 0.0 && first ? 0.0 : excess);
      frames[tile] = std::clamp(frames[tile] * (1.0 - change), 2.0, longest);
      // The previous innovation is read bilinearly at a position that rounding moves by less than 2^-12 of a quad,
      // where the neighbours' innovations are up to twice as large. One in a hundred quads, whose innovation lies in
      // the middle between two that can be stored, may be off by an eighth. The result is copied as a half. Of the
      // whole change, .6 % more was measured where history is 32 frames long, and 2^-7 is allowed.
      const double ofSlope =
          gain * std::abs(slope) * (4.0 * std::exp2(-12.0) + 0.01 / 8.0) + std::exp2(-7.0) * std::abs(change);
      EXPECT_NEAR(actual[tile].x, 1.0 - (frames[tile] - 1.0) / longest,
                  ofSlope * (longest + 1.0) / longest + std::exp2(-11.0))
          << tile.x << ", " << tile.y;
      frames[tile] = longest * (1.0 - actual[tile].x) + 1.0;
    });
    before = now;
  }
}

TEST_F(SteeredHistoryTest, AgreesWithDoublePrecision) {
  for (const double longest : {8.0, 32.0}) {
    SCOPED_TRACE(longest);
    expectAgreement(device(), longest);
  }
}

}  // namespace
}  // namespace walr::test::steered_history_test
