// Light with samples at some of the pixels only.

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "tests/error_text.h"
#include "tests/passes/comparison.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/reference/block_regression.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::sparse_light_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;
using reference::Image;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
/// No multiple of any group's side.
constexpr glm::ivec2 kSize(47, 35);

const std::vector<LightPattern> kPatterns{{2, 1}, {1, 2}, {2, 2}, {3, 3}, {1, 1, true}, {2, 2, true}};

const std::vector<LightPattern> kCountedPatterns{{1, 1, false, true}, {2, 2, false, true}};

std::string nameOf(const LightPattern& pattern) {
  return std::to_string(pattern.columns) + " x " + std::to_string(pattern.rows) + (pattern.masked ? ", masked" : "") +
         (pattern.counted ? ", counted" : "");
}

/// Numbers of samples that differ from pixel to pixel and from frame to frame: gaps, fractions, and more than count.
Image<double> mixedCounts(glm::ivec2 size, std::uint32_t index) {
  constexpr std::array kCounts{1.0, 4.0, 0.0, 2.0, 0.5, 1.0, 0.0, 400.0};
  Image<double> counts(size);
  forEachPixel(size,
               [&](glm::ivec2 p) { counts[p] = kCounts.at((3U * p.x + 5U * p.y + 3U * index) % kCounts.size()); });
  return counts;
}

/// Let a frame have light by a pattern; a mask leaves out three of eight pixels. What stands in gaps is NaN.
HostFrame sparse(HostFrame frame, const LightPattern& pattern, std::uint32_t index) {
  frame.conventions.light = pattern;
  frame.constants.lightOffset = lightOffsetOfFrame(pattern, index);
  frame.constants.previousLightOffset = lightOffsetOfFrame(pattern, index == 0 ? 0 : index - 1);
  if (pattern.masked) {
    frame.lightAlpha = Image<double>(frame.size());
    forEachPixel(frame.size(), [&](glm::ivec2 p) { frame.lightAlpha[p] = (3 * p.x + 5 * p.y + int(index)) % 8 < 5; });
  }
  if (pattern.counted) frame.lightAlpha = mixedCounts(frame.size(), index);
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (!reference::hasSample(frame, p)) frame.lighting[p] = glm::dvec3(kNaN);
  });
  return frame;
}

/// The same samples in light of the image's size with a mask.
HostFrame withMask(HostFrame frame) {
  Image<double> alpha(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) { alpha[p] = reference::hasSample(frame, p) ? 1.0 : 0.0; });
  frame.lightAlpha = alpha;
  frame.conventions.light = {1, 1, true};
  frame.constants.lightOffset = {};
  return frame;
}

/// `movingFrames` with sparse light.
std::vector<HostFrame> movingFrames(const Scene& scene, std::uint32_t count, const LightPattern& pattern,
                                    Noise noise = Noise::Exponential, const Light& light = smoothLight) {
  std::vector<HostFrame> frames = test::movingFrames(scene, kSize, count, light, noise);
  for (std::uint32_t i = 0; i < count; ++i) frames[i] = sparse(std::move(frames[i]), pattern, i);
  return frames;
}

InputConventions conventionsOf(const LightPattern& pattern) {
  InputConventions conventions;
  conventions.light = pattern;
  return conventions;
}

class SparseLight : public fg::test::GpuTest {
 protected:
  /// A method with sparse light, run frame by frame.
  DenoiserRun runOf(Denoiser& method, const LightPattern& pattern) const {
    return {device(), method, kSize, conventionsOf(pattern)};
  }
};

// It does not matter how the samples are handed over. The tests of the stages compare them with the reference.
TEST_F(SparseLight, InGroupsEqualsThatInAMaskToTheBit) {
  struct Variant {
    const char* method;
    std::vector<std::pair<const char*, const char*>> settings = {};
  };
  // Without fitted windows, which sparse light widens, and with settings that do not accumulate on the light grid,
  // where a mask has no equal. Without shared taps and without anti-aliasing, other passes read the light of pixels
  // without a surface.
  const std::pair<const char*, const char*> fixed{"walr.fit-window", "off"};
  for (const Variant& variant : {Variant{"walr", {{"accumulation.storage", "half"}, fixed}},
                                 Variant{"walr", {fixed, {"antialiasing.enabled", "off"}}},
                                 Variant{"walr", {fixed, {"antialiasing.plane-tolerance", "0.02"}}},
                                 Variant{"walr_paper"}, Variant{"flr"}, Variant{"bmfr"}, Variant{"accumulate"}}) {
    // The patterns differ in one place, which all methods share.
    const bool first = !variant.settings.empty() && variant.settings[0].second == std::string("half");
    for (const LightPattern& pattern : first ? kPatterns : std::vector<LightPattern>{{3, 3}, {2, 2, true}}) {
      SCOPED_TRACE(nameOf(pattern));
      const std::unique_ptr<Denoiser> method = makeDenoiser(variant.method);
      std::string trace = variant.method;
      for (const auto& [name, value] : variant.settings) {
        method->set(name, value);
        trace.append(", ").append(name);
      }
      SCOPED_TRACE(trace);
      DenoiserRun run = runOf(*method, pattern);
      DenoiserRun full = runOf(*method, {1, 1, true});
      for (const HostFrame& frame : movingFrames(skyBesideSurface(), 3, pattern)) {
        const Image<glm::dvec4> output = run.frame(frame);
        EXPECT_TRUE(output.pixels() == full.frame(withMask(frame)).pixels());
      }
    }
  }
}

// The stages of accumulation and anti-aliasing, in both storages.
TEST_F(SparseLight, StagesAgreeWithTheReference) {
  WalrPaperSettings halves = robustWalr();
  halves.regression.iterations = 2;
  for (const LightPattern& pattern : kPatterns) {
    SCOPED_TRACE(nameOf(pattern));
    for (const AnyWalr& settings : {AnyWalr(halves), AnyWalr(WalrSettings{})}) {
      WalrRun run(device(), kSize, settings, conventionsOf(pattern));
      expectSequence(run, movingFrames(stairs(), 4, pattern), settings);
    }
  }
}

// The same with numbers of samples, before and after history is as long as it may be. With 3 frames at most, the
// highest count is 160, which reaches the longest length that packed light holds.
TEST_F(SparseLight, StagesWithCountsAgreeWithTheReference) {
  WalrPaperSettings halves = robustWalr();
  halves.regression.iterations = 2;
  for (const LightPattern& pattern : kCountedPatterns) {
    for (const float maxHistory : {3.0F, 16.0F}) {
      SCOPED_TRACE(nameOf(pattern) + ", at most " + std::to_string(maxHistory) + " frames");
      for (AnyWalr settings : {AnyWalr(halves), AnyWalr(WalrSettings{})}) {
        settings.change([&](auto& s) { s.accumulation.maxHistory = maxHistory; });
        WalrRun run(device(), kSize, settings, conventionsOf(pattern));
        for (const std::uint32_t frames : {2U, 7U})
          expectSequence(run, movingFrames(stairs(), frames, pattern), settings);
      }
    }
  }
}

// Counts of 0 and 1 say what a mask says, even where packed light cannot hold the longest history and rounds it up.
TEST_F(SparseLight, CountsOfOneEqualAMaskToTheBit) {
  for (const char* name : {"walr", "walr_paper", "flr", "bmfr", "accumulate"}) {
    const bool isWalr = name == std::string("walr");
    // All methods read light by the same code, and only walr has a grid for groups.
    std::vector<LightPattern> patterns{{2, 2, true}};
    if (isWalr) patterns.push_back({1, 1, true});
    for (const LightPattern& masked : patterns) {
      for (const char* maxHistory : {"3", "16", "17"}) {
        SCOPED_TRACE(nameOf(masked) + ", " + name + ", at most " + maxHistory + " frames");
        LightPattern counted = masked;
        counted.masked = false;
        counted.counted = true;
        const std::unique_ptr<Denoiser> method = makeDenoiser(name);
        method->set("accumulation.max-history", maxHistory);
        method->set("accumulation.antilag", "on");
        DenoiserRun run = runOf(*method, masked);
        DenoiserRun runOfCounts = runOf(*method, counted);
        // As many frames as make history longer than 17 frames only where that matters.
        const std::uint32_t frames = isWalr ? 24 : 5;
        for (HostFrame frame : movingFrames(skyBesideSurface(), frames, masked)) {
          const Image<glm::dvec4> output = run.frame(frame);
          frame.conventions.light = counted;
          ASSERT_TRUE(output.pixels() == runOfCounts.frame(frame).pixels());
        }
      }
    }
  }
}

// A longest history is a number of frames, however many samples each has. Lengths in powers of 2 round alike, and so
// the means are equal to the bit, with antilag, too: the light goes out in frame 9.
TEST_F(SparseLight, EqualCountsWeighFramesAsOneSampleDoes) {
  const LightPattern pattern{1, 1, false, true};
  const std::unique_ptr<Denoiser> method = makeDenoiser("accumulate");
  method->set("accumulation.max-history", "6");
  method->set("accumulation.antilag", "on");
  DenoiserRun one = runOf(*method, pattern);
  DenoiserRun four = runOf(*method, pattern);
  std::uint32_t index = 0;
  for (HostFrame frame : movingFrames(skyBesideSurface(), 18, {})) {
    frame.conventions.light = pattern;
    frame.lightAlpha = Image<double>(kSize, 1.0);
    if (index++ >= 9) forEachPixel(kSize, [&](glm::ivec2 p) { frame.lighting[p] *= 0.125; });
    const Image<glm::dvec4> output = one.frame(frame);
    frame.lightAlpha = Image<double>(kSize, 4.0);
    ASSERT_TRUE(output.pixels() == four.frame(frame).pixels());
  }
}

// Up to the longest history, the mean is that of all samples. It is rounded to a half in each frame, by 2^-11 of it at
// most; halves hold its length exactly. No history comes near 80 frames of the lowest count.
TEST_F(SparseLight, CountedLightIsTheMeanOfAllSamples) {
  constexpr std::uint32_t kFrames = 12;
  const LightPattern pattern{1, 1, false, true};
  const std::unique_ptr<Denoiser> method = makeDenoiser("accumulate");
  method->set("accumulation.max-history", "80");
  DenoiserRun run = runOf(*method, pattern);
  Image<glm::dvec3> sums(kSize);
  Image<double> brightest(kSize, 0.0);
  Image<double> samples(kSize, 0.0);
  Image<glm::dvec4> output;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const HostFrame frame = sparse(renderStill(flatWall(), kSize, i), pattern, i);
    output = run.frame(frame);
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const double count = std::min(reference::sampleCount(frame, p), 480.0 / 80.0);
      if (count == 0.0) return;
      sums[p] += count * frame.lighting[p];
      samples[p] += count;
      for (int c = 0; c < 3; ++c) brightest[p] = std::max(brightest[p], frame.lighting[p][c]);
    });
  }
  forEachPixel(kSize, [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(output[p][c], sums[p][c] / samples[p], kFrames * brightest[p] / 2048.0);
  });
}

// Where counts vary, the result keeps the energy of the light. A mean of n samples has a relative standard deviation of
// 1 / sqrt(n) here, and each of the 1715 pixels has six samples in the mean of eight counts, the last of which is cut
// to 30: over 136 frames the mean of all results has one of some 0.2 %.
TEST_F(SparseLight, KeepsTheEnergyWhereCountsVary) {
  const LightPattern pattern{1, 1, false, true};
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  DenoiserRun run = runOf(*method, pattern);
  double expected = 0.0;
  double shown = 0.0;
  for (std::uint32_t i = 0; i < 144; ++i) {
    HostFrame frame = renderStill(flatWall(), kSize, i);
    const HostFrame truth = renderStill(flatWall(), kSize, i, Noise::None);
    const Image<double> counts = mixedCounts(kSize, i);
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const double spread = 1.0 / std::sqrt(std::max(counts[p], 1.0));
      frame.lighting[p] = truth.lighting[p] + (frame.lighting[p] - truth.lighting[p]) * spread;
    });
    const Image<glm::dvec4> output = run.frame(sparse(frame, pattern, i));
    if (i < 8) continue;
    forEachPixel(kSize, [&](glm::ivec2 p) {
      shown += output[p].g;
      expected += truth.lighting[p].g;
    });
  }
  EXPECT_NEAR(shown / expected, 1.0, 0.005);
}

// Fits of the light grid, from the samples of one frame. The bound is that of regressions over all pixels
// (block_regression_test.cpp): 2e-4 for moments in halves at the noise of one sample.
TEST_F(SparseLight, RegressionOnTheLightGridAgreesWithTheReference) {
  WalrSettings settings;
  settings.blocks.iterations = 2;
  settings.blocks.sdfFraction = 0.0F;
  settings.antialiasing.storage = LightStorage::Half;  // The filter's result then has no coarser rounding.
  settings.blocks.coarseSigma = 0.15F;                 // As wide in pixels as the default at 216 lines.
  for (const LightPattern& pattern : {LightPattern{1, 2}, LightPattern{2, 2}, LightPattern{3, 3}}) {
    for (const std::uint32_t size : {4U, 5U, 8U}) {
      SCOPED_TRACE(nameOf(pattern) + ", blocks of " + std::to_string(size));
      settings.blocks.size = size;
      WalrRun run(device(), kSize, settings, conventionsOf(pattern));
      const HostFrame frame = movingFrames(stairs(), 2, pattern).back();
      const WalrStages stages = run.frame(frame);
      ASSERT_TRUE(stages.onLightGrid);
      const Image<glm::dvec3> expected =
          reference::blockRegression(frame, stages.guides, stages.accumulated, settings.blocks, true);
      EXPECT_LE(surfaceRmse(stages.guides, stages.filtered, expected), 2e-4);
    }
  }
}

// Light without noise and of one value stays so, from the first frame on: no pixel is a hole, and none is dark.
// Packed light holds this value exactly. Moments and slopes are halves, whose rounding a slope of up to a few units
// carries to features far from the mean: the tolerance is eight roundings of a half.
TEST_F(SparseLight, ConstantLightStaysConstantFromTheFirstFrameOn) {
  constexpr double kLight = 0.75;
  const Light constant = [](glm::dvec3, glm::dvec3) { return glm::dvec3(kLight); };
  std::vector<LightPattern> patterns = kPatterns;
  patterns.insert(patterns.end(), kCountedPatterns.begin(), kCountedPatterns.end());
  for (const LightPattern& pattern : patterns) {
    SCOPED_TRACE(nameOf(pattern));
    const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
    DenoiserRun run = runOf(*method, pattern);
    for (const HostFrame& frame : movingFrames(thinBars(), 4, pattern, Noise::None, constant)) {
      const Image<glm::dvec4> output = run.frame(frame);
      double worst = 0.0;
      forEachPixel(kSize, [&](glm::ivec2 p) {
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(output[p][c] - kLight));
        ASSERT_TRUE(std::isfinite(output[p].r + output[p].g + output[p].b));
      });
      EXPECT_LE(worst, kLight / 256.0);
    }
  }
}

// Over many frames the mean of the result is that of the light: the exponential noise of a frame has a relative
// standard deviation of 1. With 1/9 of 1715 pixels in 72 frames, of which the first 8 are left out, the mean of all
// samples has one of 0.9 %, so the light is compared with the mean of the very samples that the method got.
TEST_F(SparseLight, KeepsTheEnergyOfItsSamples) {
  for (const LightPattern& pattern : {LightPattern{2, 2}, LightPattern{3, 3}}) {
    SCOPED_TRACE(nameOf(pattern));
    const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
    DenoiserRun run = runOf(*method, pattern);
    double sampled = 0.0;
    double samples = 0.0;
    double shown = 0.0;
    double pixels = 0.0;
    constexpr std::uint32_t kFrames = 144;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      HostFrame frame = renderStill(flatWall(), kSize, i);
      forEachPixel(kSize, [&](glm::ivec2 p) { frame.lighting[p] = frame.lighting[p] / 2.0; });
      const HostFrame gaps = sparse(frame, pattern, i);
      const Image<glm::dvec4> output = run.frame(gaps);
      forEachPixel(kSize, [&](glm::ivec2 p) {
        shown += output[p].g;
        pixels += 1.0;
        if (!reference::hasSample(gaps, p)) return;
        sampled += frame.lighting[p].g;
        samples += 1.0;
      });
    }
    EXPECT_NEAR(shown / pixels / (sampled / samples), 1.0, 0.005);
  }
}

// A method that needs all samples says so, and so does a setting.
TEST_F(SparseLight, IsRefusedByNameWhereAllSamplesAreNeeded) {
  for (const char* name : {"svgf", "refwlr", "flnr", "joint_bilateral", "none"}) {
    const std::unique_ptr<Denoiser> method = makeDenoiser(name);
    fg::test::expectError(
        [&] {
          runOf(*method, {2, 2});
        },
        {"method '" + std::string(name) + "'", "walr, walr_paper, bmfr, flr, accumulate"});
  }
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  method->set("spatial-only", "on");
  fg::test::expectError([&] { runOf(*method, {1, 1, true}); }, {"setting spatial-only"});
}

// A sample and the history of the same pixel tell the share of accumulated light. Sparse light lacks one of them.
TEST_F(SparseLight, HasNoShareOfAccumulatedLight) {
  for (const LightPattern& pattern : {LightPattern{2, 2}, LightPattern{1, 1, true}, LightPattern{1, 1, false, true}}) {
    SCOPED_TRACE(nameOf(pattern));
    const auto standard = makeDenoiser("walr"), without = makeDenoiser("walr");
    without->set("blocks.residual", "off");
    DenoiserRun run = runOf(*standard, pattern);
    DenoiserRun runWithout = runOf(*without, pattern);
    for (const HostFrame& frame : movingFrames(stairs(), 4, pattern)) {
      const Image<glm::dvec4> output = run.frame(frame);
      EXPECT_TRUE(output.pixels() == runWithout.frame(frame).pixels());
    }
  }
}

// A light that goes out is as dark after a few frames as with light at every pixel, for which antilag is tuned: the
// gaps are no change, and do not hide one.
TEST_F(SparseLight, FollowsAChangeOfTheLight) {
  for (const LightPattern& pattern : {LightPattern{2, 1}, LightPattern{2, 2}, LightPattern{3, 3}}) {
    SCOPED_TRACE(nameOf(pattern));
    const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
    DenoiserRun run = runOf(*method, pattern);
    double before = 0.0;
    double after = 0.0;
    constexpr std::uint32_t kChange = 40;
    const std::uint32_t settled = kChange + 4 * pattern.columns * pattern.rows;
    for (std::uint32_t i = 0; i <= settled; ++i) {
      HostFrame frame = renderStill(flatWall(), kSize, i);
      if (i >= kChange) forEachPixel(kSize, [&](glm::ivec2 p) { frame.lighting[p] *= 0.1; });
      const Image<glm::dvec4> output = run.frame(sparse(frame, pattern, i));
      double mean = 0.0;
      for (const glm::dvec4& pixel : output.pixels()) mean += pixel.g / double(output.pixels().size());
      if (i + 1 == kChange) before = mean;
      if (i == settled) after = mean;
    }
    EXPECT_LT(after, 0.25 * before);
  }
}

}  // namespace
}  // namespace walr::test::sparse_light_test
