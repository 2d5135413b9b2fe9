#include "passes/regression/block_regression.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "tests/error_text.h"
#include "tests/passes/block_filter.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/block_regression.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::block_regression_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(45, 34);  // Not a multiple of the block size.

// Gives about the width in pixels that the default has at 216 lines. At 34 lines the default's window would hold hardly
// more samples than features.
constexpr float kCoarseSigma = 0.15F;

/// Inputs of the regression.
struct Inputs {
  HostFrame frame;
  Image<Guide> guides;
  Image<glm::dvec4> accumulated;
};

Inputs inputsOf(const Scene& scene) {
  Inputs inputs;
  inputs.frame = renderStill(scene, kSize);
  inputs.guides = reference::prepareGuides(inputs.frame, Storage::Quantised, {}, kOcclusionInSmallImages);
  inputs.accumulated = withAlpha(inputs.frame.lighting);
  for (glm::dvec4& sample : inputs.accumulated.pixels()) sample.a = 1.0;
  return inputs;
}

/// The regression and its reconstruction alone.
class RegressionRun {
 public:
  RegressionRun(const fg::test::TestDevice& device, const BlockRegressionSettings& settings)
      : run_(
            device, kSize, 1,
            [&](fg::Graph& graph, fg::Buffer frame, const walr::Guides& guides, const auto& inputs) {
              return addBlockFilter(graph, frame, {inputs[0], LightingAlpha::SampleCount}, guides, settings);
            },
            true) {}

  Image<glm::dvec4> filter(const Inputs& inputs) { return run_.run(inputs.frame, inputs.guides, {inputs.accumulated}); }

 private:
  FilterRun run_;
};

double oneSample(glm::ivec2) {
  return 1.0;
}

// Column at which the light steps; it is darker on the left.
constexpr int kStep = 24;

/// Filter noise-free light with a step, on a wall without features. Returns the largest relative error of the pixels
/// whose column `counts`.
template <typename Counts>
double farthestFromOwn(const fg::test::TestDevice& device, const BlockRegressionSettings& settings, Counts counts) {
  RegressionRun run(device, settings);
  Inputs inputs = inputsOf(flatWall());
  const auto lightOf = [](glm::ivec2 p) { return p.x < kStep ? 0.25 : 2.0; };
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    inputs.accumulated[p] = glm::dvec4(glm::dvec3(lightOf(p)), 64.0);
    inputs.guides[p].features = inputs.guides[glm::ivec2(0)].features;
    inputs.guides[p].occlusion = 0.0;
  });
  const Image<glm::dvec4> actual = run.filter(inputs);
  double farthest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (counts(p.x)) farthest = std::max(farthest, std::abs(actual[p].x - lightOf(p)) / lightOf(p));
  });
  return farthest;
}

class BlockRegression : public fg::test::GpuTest {
 protected:
  /// @param historyLength history length of each pixel
  template <typename Lengths = double(glm::ivec2)>
  void expectAgreement(const BlockRegressionSettings& settings, const Lengths& historyLength = oneSample) {
    // Design goal for centred moments in halves, at the noise of one sample per pixel; the regression over pixels,
    // which rounds as often, has the same.
    constexpr double kBound = 2e-4;
    RegressionRun run(device(), settings);
    for (const NamedScene& scene : allScenes()) {
      Inputs inputs = inputsOf(scene.scene);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) { inputs.accumulated[p].a = historyLength(p); });
      const Image<glm::dvec4> actual = run.filter(inputs);
      const auto expected = reference::blockRegression(inputs.frame, inputs.guides, inputs.accumulated, settings);
      const double rms = surfaceRmse(inputs.guides, actual, expected);
      EXPECT_LE(rms, kBound) << scene.name;
      RecordProperty(std::string("distance, ") + scene.name, std::to_string(rms));
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        if (inputs.guides[p].depth != 0.0) return;
        for (int c = 0; c < 3; ++c) EXPECT_EQ(actual[p][c], inputs.accumulated[p][c]) << scene.name;
      });
    }
  }
};

TEST_F(BlockRegression, BlocksOfTwoAgreeWithBruteForce) {
  expectAgreement({.size = 2, .iterations = 2, .sdfFraction = 0.0F, .coarseSigma = kCoarseSigma});
}

TEST_F(BlockRegression, BlocksOfFourAgreeWithBruteForce) {
  expectAgreement({.size = 4, .iterations = 1, .sdfFraction = 0.0F, .coarseSigma = kCoarseSigma});
}

TEST_F(BlockRegression, SteppingByTheEdgeDistanceAgreesWithBruteForce) {
  expectAgreement({.size = 2, .iterations = 3, .coarseSigma = kCoarseSigma});
}

TEST_F(BlockRegression, CoarseFitsAgreeWithBruteForce) {
  // The coarse window has a standard deviation of 5 pixels, on cells of one, two and four blocks a side. The share of
  // the blocks' own fits is small. The image's size is not a multiple of any cell size.
  BlockRegressionSettings settings{.iterations = 1, .coarseSigma = kCoarseSigma, .coarseSamples = 10000.0F};
  for (const auto& [size, resolution] :
       {std::pair(2U, 2.0F), {2U, 0.5F}, {3U, 1.0F}, {4U, 2.0F}, {5U, 0.5F}, {8U, 1.0F}, {8U, 2.0F}}) {
    settings.size = size;
    settings.coarseResolution = resolution;
    expectAgreement(settings);
  }
}

TEST(CoarseSamples, FallWithTheSquareOfTheHeightInLargePictures) {
  for (const std::uint32_t height : {1U, 216U, 360U}) EXPECT_EQ(coarseSamplesAt(height, 3200.0F), 3200.0F);
  EXPECT_FLOAT_EQ(coarseSamplesAt(720, 3200.0F), 800.0F);
  EXPECT_FLOAT_EQ(coarseSamplesAt(1080, 3200.0F), 3200.0F / 9.0F);
  EXPECT_EQ(coarseSamplesAt(2160, 0.0F), 0.0F);
}

// Pixels have unequal history lengths, and the width of coarse windows varies. No pixel is without a sample: in a block
// without samples, a weight that is 0 but for rounding would be the whole window.
TEST_F(BlockRegression, UnequalHistoryLengthsAgreeWithBruteForce) {
  BlockRegressionSettings settings{.size = 2, .iterations = 2, .coarseSigma = kCoarseSigma, .coarseSamples = 300.0F};
  const auto historyLength = [](glm::ivec2 p) { return double(((p.x * 5 + p.y * 3) % 4 + 1) * (p.x / 15 + 1)); };
  expectAgreement(settings, historyLength);
  // Not narrower: over windows of half a cell, twelve pixels, fits of six coefficients depend as much on rounding as
  // on the light (a distance of up to 1e-3).
  settings.coarseNarrowing = 0.4F;
  expectAgreement(settings, historyLength);
}

TEST_F(BlockRegression, GrowthAgreesWithBruteForce) {
  BlockRegressionSettings settings{.size = 2, .iterations = 2, .coarseSigma = kCoarseSigma, .coarseSamples = 300.0F};
  for (const float errors : {0.5F, 100.0F}) {
    settings.growthErrors = errors;
    settings.coarseGrowthErrors = errors;
    for (const float occlusion : {0.0F, 20.0F}) {
      settings.coarseGrowthOcclusion = occlusion;
      expectAgreement(settings);
    }
  }
}

// Windows on the left have few samples, those on the right have many, and in between the coarse fit fades out. The
// coarse fit gets no share from 20 x (1 / .15 - 1) = 113 samples on; a block's own four pixels hold 4 or 400. Coarse
// windows do not narrow, for the reason given above.
TEST_F(BlockRegression, ConvergedBlocksAgreeWithBruteForce) {
  BlockRegressionSettings settings{
      .size = 2, .iterations = 1, .coarseSigma = kCoarseSigma, .coarseNarrowing = 0.0F, .coarseSamples = 20.0F};
  const auto historyLength = [](glm::ivec2 p) { return p.x < kSize.x / 2 ? 1.0 : 100.0; };
  for (const float least : {1e-6F, 0.15F, 0.4F}) {
    settings.coarseLeastShare = least;
    expectAgreement(settings, historyLength);
  }
}

// The light steps at a block's border. Every block must keep the light of its own side and not grow over the step. The
// pixels between the centres of the blocks on both sides are mixed and do not count.
TEST_F(BlockRegression, BlocksDoNotGrowOverAStepInTheLight) {
  const auto farthest = [&](float errors) {
    return farthestFromOwn(device(), {.size = 2, .iterations = 3, .growthErrors = errors, .coarseSamples = 0.0F},
                           [](int x) { return x < kStep - 1 || x > kStep; });
  };
  EXPECT_LE(farthest(8.5F), reference::kHalfRoundoff);
  EXPECT_GT(farthest(1e6F), 0.1);
}

// The same for cells. A cell within reach of the step has light of both sides in its window from the start, so its mean
// is uncertain: only a strict test keeps such cells from joining others.
TEST_F(BlockRegression, CellsDoNotGrowOverAStepInTheLight) {
  // Three standard deviations of half a cell (of 2 pixels), half a cell, and the cells between.
  constexpr int kReach = 6;
  const auto farthest = [&](float errors) {
    return farthestFromOwn(device(),
                           {.size = 2,
                            .iterations = 1,
                            .coarseSigma = 1.0F / float(kSize.y),
                            .coarseResolution = 0.5F,
                            .coarseGrowthErrors = errors,
                            .coarseSamples = 1e6F},
                           [](int x) { return std::abs(x - kStep) > kReach; });
  };
  EXPECT_LE(farthest(0.01F), reference::kHalfRoundoff);
  EXPECT_GT(farthest(1e6F), 0.1);
}

TEST_F(BlockRegression, ConstantLightIsUnchanged) {
  const glm::dvec3 light(0.25, 3.0, 1000.0);
  RegressionRun run(device(), {.size = 2, .iterations = 2});
  for (const NamedScene& scene : allScenes()) {
    Inputs inputs = inputsOf(scene.scene);
    for (glm::dvec4& sample : inputs.accumulated.pixels()) sample = glm::dvec4(light, 1.0);
    const Image<glm::dvec4> actual = run.filter(inputs);
    // Means of equal halves are merged about the first of them, so only single precision rounds: the constant of a
    // fit and the mixing of eight fits.
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(actual[p][c], light[c], halfTolerance(light[c], 64.0 * reference::kFloatRoundoff * light[c]))
            << scene.name << " " << p.x << " " << p.y;
    });
  }
}

// With the covariance M of a window, the ridge r changes the slope s of a linear signal to (M + r)^-1 M s. The mean
// error over the window is then at most sqrt(r) |s| / 2.
TEST_F(BlockRegression, ASignalLinearInTheFeaturesIsReproduced) {
  constexpr double kRidge = 1e-6;
  RegressionRun run(device(), {.size = 2, .iterations = 2, .ridge = static_cast<float>(kRidge)});
  Inputs inputs = inputsOf(bumpyWall(0.1));
  const glm::dvec3 slope(0.5, -1.0, 0.7);
  const double occlusionSlope = -0.8;
  Image<glm::dvec3> signal(kSize);
  double largest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 n = reference::octahedralDecode(inputs.guides[p].features);
    signal[p] = glm::dvec3(4.0 + glm::dot(n, slope) + occlusionSlope * inputs.guides[p].occlusion);
    inputs.accumulated[p] = glm::dvec4(signal[p], 1.0);
    largest = std::max(largest, signal[p].x);
  });
  const Image<glm::dvec4> actual = run.filter(inputs);
  double squares = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { squares += std::pow(actual[p].x - signal[p].x, 2.0); });
  const double slopeLength = glm::length(glm::dvec4(slope, occlusionSlope));
  const double rounding = 4.0 * reference::kHalfRoundoff * largest;  // Signal, moments and result are halves.
  EXPECT_LE(std::sqrt(squares / double(signal.pixels().size())), 0.5 * std::sqrt(kRidge) * slopeLength + rounding);
}

TEST_F(BlockRegression, ScalingTheInputByAPowerOfTwoScalesTheOutput) {
  RegressionRun run(device(), {.size = 2, .iterations = 2});
  const auto scaled = [&](double factor) {
    Inputs inputs = inputsOf(sphere());
    for (glm::dvec4& sample : inputs.accumulated.pixels()) sample = glm::dvec4(factor * glm::dvec3(sample), sample.a);
    return run.filter(inputs);
  };
  // The radiance is so high that covariances stay in the normal range of halves, and so low that no slope leaves it.
  const Image<glm::dvec4> before = scaled(16.0);
  const Image<glm::dvec4> after = scaled(128.0);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[p][c], 8.0 * before[p][c], halfTolerance(after[p][c], 0.0));
  });
}

TEST_F(BlockRegression, PixelsWithoutASampleAreIgnored) {
  RegressionRun run(device(), {.size = 2, .iterations = 2});
  Inputs inputs = inputsOf(sphere());
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const bool sampled = (p.x * 7 + p.y * 3) % 10 != 0;
    inputs.accumulated[p] = sampled ? glm::dvec4(0.75, 0.75, 0.75, 1.0) : glm::dvec4(0.0);
  });
  const Image<glm::dvec4> actual = run.filter(inputs);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (inputs.guides[p].depth > 0.0) {
      EXPECT_NEAR(actual[p].x, 0.75, halfTolerance(0.75, 64.0 * reference::kFloatRoundoff)) << p.x << " " << p.y;
    }
  });
}

TEST(BlockRegressionSettings, AnEmptyPlaneRampIsRejected) {
  fg::Graph graph;
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, {64, 64}});
  const BlockRegressionSettings settings{.planeNear = 0.1F, .planeFar = 0.1F};
  const auto add = [&] { addBlockRegression(graph, {}, {lighting, LightingAlpha::SampleCount}, {}, settings); };
  fg::test::expectError(add, {"blocks.plane-near"});
}

TEST(BlockRegressionSettings, TooManyBlocksAreRejectedWithTheSetting) {
  fg::Graph graph;
  const fg::Extent extent{4096, 2160};
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});
  Guides guides;
  guides.depth = graph.texture("depth", {VK_FORMAT_R32_UINT, extent});
  const auto add = [&] { addBlockRegression(graph, {}, {lighting, LightingAlpha::SampleCount}, guides, {.size = 2}); };
  fg::test::expectError(add, {"blocks.size"});
}

}  // namespace
}  // namespace walr::test::block_regression_test
