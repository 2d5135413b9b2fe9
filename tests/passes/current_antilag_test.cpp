// Antilag in the frame in which the light changes (passes/WALR.md, 3): against a calculation in double precision, and
// by what the first frame shows.

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include "tests/passes/block_filter.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/antilag.h"
#include "tests/passes/reference/block_regression.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::current_antilag_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(45, 34);  // Not a multiple of the tiles.
constexpr glm::ivec2 kTiles = (kSize + reference::kChangeTile - 1) / reference::kChangeTile;
constexpr float kMaxHistory = 8.0F;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A frame whose light has changed: the mean with the history of another light, and the antilag factor.
struct ChangedFrame {
  HostFrame frame;
  Image<reference::Guide> guides;
  Image<glm::dvec4> mean{kSize};
  Image<glm::dvec4> lighting{kSize};
  Image<glm::dvec4> antilag{kTiles};  // Red.
};

/// @param factorAt antilag factor of a tile
template <typename Factor>
ChangedFrame changedFrame(const Scene& scene, const Factor& factorAt) {
  ChangedFrame changed;
  changed.frame = renderStill(scene, kSize);
  changed.guides = reference::prepareGuides(changed.frame, reference::Storage::Quantised, {}, kOcclusionInSmallImages);
  changed.lighting = withAlpha(changed.frame.lighting);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> history(1.4, 1.6);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    glm::dvec4& light = changed.lighting[p];
    if ((p.x * 7 + p.y * 3) % 11 == 0 && changed.guides[p].depth > 0.0) light.g = kNaN;
    const bool counts = std::isfinite(light.g);
    const double frames = 1.0 + (p.x + 2 * p.y) % 9;
    const glm::dvec3 h = glm::dvec3(history(random), history(random), history(random));
    const glm::dvec3 m = !counts ? h : frames < 2.0 ? glm::dvec3(light) : h + (glm::dvec3(light) - h) / frames;
    changed.mean[p] = glm::dvec4(m, frames);
    for (int c = 0; c < 3; ++c) changed.mean[p][c] = reference::roundToHalf(m[c]);
  });
  reference::forEachPixel(kTiles, [&](glm::ivec2 t) { changed.antilag[t].r = factorAt(t); });
  return changed;
}

/// The regression over blocks with antilag, in double precision. A block's pixels share the factor of its centre.
Image<glm::dvec3> expectedFrom(const ChangedFrame& changed, const BlockRegressionSettings& settings) {
  Image<double> factors(kTiles);
  reference::forEachPixel(kTiles, [&](glm::ivec2 t) { factors[t] = changed.antilag[t].r; });
  Image<glm::dvec4> mean = changed.mean;
  const int side = static_cast<int>(settings.size);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 light(changed.lighting[p]);
    const glm::dvec2 centre = glm::dvec2(p / side * side) + 0.5 * side;
    const reference::Bounded longest =
        reference::longestHistory(factors, centre, 0.0, kMaxHistory, std::isfinite(light.g));
    mean[p] = reference::withLongestHistory(mean[p], light, longest.value);
  });
  return reference::blockRegression(changed.frame, changed.guides, mean, settings);
}

class CurrentAntilagTest : public fg::test::GpuTest {
 protected:
  [[nodiscard]] Image<glm::dvec4> filtered(const ChangedFrame& changed, const BlockRegressionSettings& settings) const {
    FilterRun run(
        device(), kSize, std::vector<glm::ivec2>{kSize, kSize, kTiles},
        [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
          const BlockLight light{.accumulated = inputs[0],
                                 .alpha = LightingAlpha::SampleCount,
                                 .lighting = inputs[1],
                                 .antilag = CurrentAntilag{inputs[2], kMaxHistory}};
          return addBlockFilter(graph, frame, light, guides, settings);
        },
        true);
    return run.run(changed.frame, changed.guides, {changed.mean, changed.lighting, changed.antilag});
  }
};

TEST_F(CurrentAntilagTest, FitsAgreeWithBruteForce) {
  // As in block_regression_test.cpp.
  constexpr double kBound = 2e-4;
  BlockRegressionSettings settings{
      .iterations = 1, .coarseSigma = 0.15F, .coarseNarrowing = 0.0F, .coarseSamples = 300.0F};
  settings.share.enabled = false;
  // Halves hold these factors exactly.
  const auto factorAt = [](glm::ivec2 t) { return 0.25 * ((t.x + 2 * t.y) % 5); };
  for (const std::uint32_t size : {2U, 4U, 5U}) {
    settings.size = size;
    for (const NamedScene& scene : allScenes()) {
      const ChangedFrame changed = changedFrame(scene.scene, factorAt);
      const Image<glm::dvec4> actual = filtered(changed, settings);
      const Image<glm::dvec3> expected = expectedFrom(changed, settings);
      EXPECT_LE(surfaceRmse(changed.guides, actual, expected), kBound) << scene.name << ", blocks of " << size;
    }
  }
}

/// The filter with the share of accumulated light, over two frames: the second has the statistics of the first.
/// @param inputs mean, lighting and, if there is antilag, its factor
Image<glm::dvec4> mixedInSecondFrame(const fg::test::TestDevice& device, const std::vector<Image<glm::dvec4>>& inputs) {
  const HostFrame frame = renderStill(flatWall(), kSize);
  const auto guides = reference::prepareGuides(frame, reference::Storage::Quantised, {}, kOcclusionInSmallImages);
  std::vector<glm::ivec2> sizes;
  for (const Image<glm::dvec4>& input : inputs) sizes.push_back(input.size());
  FilterRun run(
      device, kSize, sizes,
      [&](fg::Graph& graph, fg::Buffer constants, const Guides& given, const std::vector<fg::Texture>& textures) {
        BlockLight light{.accumulated = textures[0], .alpha = LightingAlpha::SampleCount, .lighting = textures[1]};
        if (textures.size() > 2) light.antilag = CurrentAntilag{textures[2], kMaxHistory};
        return addBlockFilter(graph, constants, light, given, {.size = 4, .iterations = 2, .coarseSigma = 0.15F});
      },
      true);
  static_cast<void>(run.run(frame, guides, inputs));
  return run.run(frame, guides, inputs);
}

// With a factor of 5/8, three of eight frames count, and a mean over eight frames becomes one over four. All light is a
// multiple of 1/16, so that halves hold both means exactly.
TEST_F(CurrentAntilagTest, ShareTakesTheShortenedMean) {
  constexpr double kFrames = 8.0;
  constexpr double kLongest = 3.0;
  Image<glm::dvec4> mean(kSize), shortened(kSize), lighting(kSize), antilag(kTiles);
  for (glm::dvec4& factor : antilag.pixels()) factor.r = 1.0 - kLongest / double(kMaxHistory);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> sixteenths(16, 31);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double stripe = p.x / 2 % 2 == 0 ? 1.0 : 2.0;  // No guide shows it.
    const glm::dvec3 y(stripe * sixteenths(random) / 16.0);
    const glm::dvec3 h(stripe * sixteenths(random) / 16.0);
    lighting[p] = glm::dvec4(y, 1.0);
    mean[p] = glm::dvec4(h + (y - h) / kFrames, kFrames);
    if (p.x % 7 == 3 && p.y % 5 == 1) {
      lighting[p].g = kNaN;
      mean[p] = glm::dvec4(h, kFrames);
    }
    shortened[p] = reference::withLongestHistory(mean[p], glm::dvec3(lighting[p]), kLongest);
  });
  const Image<glm::dvec4> actual = mixedInSecondFrame(device(), {mean, lighting, antilag});
  const Image<glm::dvec4> expected = mixedInSecondFrame(device(), {shortened, lighting});
  const Image<glm::dvec4> ofWholeMean = mixedInSecondFrame(device(), {mean, lighting});
  double farthest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    // Rounding of the quotient in single precision may move the last rounding to halves by one step.
    EXPECT_NEAR(actual[p].g, expected[p].g, 2.0 * reference::kHalfRoundoff * expected[p].g) << p.x << ", " << p.y;
    farthest = std::max(farthest, std::abs(ofWholeMean[p].g - expected[p].g));
  });
  EXPECT_GT(farthest, 0.05);  // The two means do give different results.
}

/// Means over the surfaces of what is shown before a lamp goes out and in the first frame after it, in green.
struct Shown {
  double before = 0.0;
  double after = 0.0;
};

Shown shownAround(WalrRun& run, glm::ivec2 size, const LightPattern& pattern, double change) {
  constexpr std::uint32_t kBefore = 12;
  Shown shown;
  for (std::uint32_t i = 0; i <= kBefore; ++i) {
    HostFrame frame = renderStill(flatWall(), size, i);
    frame.conventions.light = pattern;
    frame.constants.lightOffset = lightOffsetOfFrame(pattern, i);
    frame.constants.previousLightOffset = lightOffsetOfFrame(pattern, i == 0 ? 0 : i - 1);
    for (glm::dvec3& light : frame.lighting.pixels()) light = glm::dvec3(i == kBefore ? change : 1.0);
    const WalrStages stages = run.frame(frame);
    double sum = 0.0;
    for (const glm::dvec4& pixel : stages.output.pixels()) sum += pixel.g / double(size.x * size.y);
    (i == kBefore ? shown.after : shown.before) = sum;
  }
  return shown;
}

// Light without noise is beyond doubt other light, so that no history is left in the mean. Anti-aliasing clips its own
// history to a box of at least a step of packed light, 1/128, about the new light.
TEST_F(CurrentAntilagTest, TheFirstFrameShowsTheNewLight) {
  constexpr glm::ivec2 kLarge(98, 66);
  for (const WalrSettings& settings : {WalrSettings{}, walrWithoutShare()}) {
    for (const LightPattern& pattern : {LightPattern{}, LightPattern{2, 2}}) {
      for (const double change : {0.25, 4.0}) {
        InputConventions conventions;
        conventions.light = pattern;
        WalrRun run(device(), kLarge, settings, conventions, false);
        const Shown shown = shownAround(run, kLarge, pattern, change);
        EXPECT_NEAR(shown.before, 1.0, 1.0 / 128.0);
        EXPECT_NEAR(shown.after, change, change / 128.0)
            << "share " << settings.blocks.share.enabled << ", groups of " << pattern.columns << " x " << pattern.rows;
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::current_antilag_test
