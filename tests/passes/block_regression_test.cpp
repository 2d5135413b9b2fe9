#include "passes/block_regression.h"

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

namespace walr::test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(45, 34);  // No multiple of a block.

// About the pixels that it is at 216 lines. At 34 the default's window would hold hardly more samples than features.
constexpr float kCoarseSigma = 0.15F;

/// A frame as the regression takes it.
struct Inputs {
  HostFrame frame;
  Image<Guide> guides;
  Image<glm::dvec4> accumulated;
};

Inputs inputsOf(const Scene& scene) {
  Inputs inputs;
  inputs.frame = renderStill(scene, kSize);
  inputs.guides = reference::prepareGuides(inputs.frame, Storage::Quantised, {}, kOcclusionInSmallPictures);
  inputs.accumulated = withAlpha(inputs.frame.lighting);
  for (glm::dvec4& sample : inputs.accumulated.pixels()) sample.a = 1.0;
  return inputs;
}

/// The regression alone.
class RegressionRun {
 public:
  RegressionRun(const fg::vk::Device& device, const BlockRegressionSettings& settings)
      : run_(device, kSize, 1, [&](fg::Graph& graph, fg::Buffer frame, const walr::Guides& guides, const auto& inputs) {
          return addBlockFilter(graph, frame, {inputs[0], LightingAlpha::SampleCount}, guides, settings);
        }) {}

  Image<glm::dvec4> filter(const Inputs& inputs) { return run_.run(inputs.frame, inputs.guides, {inputs.accumulated}); }

 private:
  FilterRun run_;
};

double toneMapped(double x) {
  return x / (1.0 + x);
}

/// Root mean square difference after the tone map x / (1 + x), over surfaces.
double distance(const Image<Guide>& guides, const Image<glm::dvec4>& a, const Image<glm::dvec3>& b) {
  double squares = 0.0;
  int count = 0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    for (int c = 0; c < 3; ++c, ++count) squares += std::pow(toneMapped(a[p][c]) - toneMapped(b[p][c]), 2.0);
  });
  return count > 0 ? std::sqrt(squares / count) : 0.0;
}

double onePath(glm::ivec2) {
  return 1.0;
}

// Left of it the light is darker.
constexpr int kStep = 24;

/// Light without noise that steps on a wall without features: the largest relative difference from their own side's of
/// the pixels that count.
template <typename Counts>
double farthestFromOwn(const fg::vk::Device& device, const BlockRegressionSettings& settings, Counts counts) {
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
  /// @param paths of a pixel
  template <typename Paths = double(glm::ivec2)>
  void expectAgreement(const BlockRegressionSettings& settings, const Paths& paths = onePath) {
    // Centred moments in halves stay this close to double precision where the input itself has the noise of one path a
    // pixel (design figure of the regression per pixel, which stores as often).
    constexpr double kBound = 2e-4;
    RegressionRun run(device(), settings);
    for (const NamedScene& scene : allScenes()) {
      Inputs inputs = inputsOf(scene.scene);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) { inputs.accumulated[p].a = paths(p); });
      const Image<glm::dvec4> actual = run.filter(inputs);
      const auto expected = reference::blockRegression(inputs.frame, inputs.guides, inputs.accumulated, settings);
      const double rms = distance(inputs.guides, actual, expected);
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
  // A window of 5 pixels' standard deviation, on cells of one, two and four blocks a side, beside which the blocks' own
  // fits hardly count. The picture is no multiple of any of these.
  BlockRegressionSettings settings{.iterations = 1, .coarseSigma = kCoarseSigma, .coarseSamples = 10000.0F};
  for (const std::uint32_t size : {2U, 3U, 4U, 5U, 8U}) {
    for (const float resolution : {2.0F, 1.0F, 0.5F}) {
      settings.size = size;
      settings.coarseResolution = resolution;
      expectAgreement(settings);
    }
  }
}

// As history leaves them, some pixels have more paths than others, and coarse windows narrow from place to place. None
// is without: of a block whose own pixels are, a weight that is 0 but for rounding would be the window.
TEST_F(BlockRegression, PathsAgreeWithBruteForce) {
  BlockRegressionSettings settings{.size = 2, .iterations = 2, .coarseSigma = kCoarseSigma, .coarseSamples = 300.0F};
  const auto paths = [](glm::ivec2 p) { return double(((p.x * 5 + p.y * 3) % 4 + 1) * (p.x / 15 + 1)); };
  expectAgreement(settings, paths);
  // No narrower: of windows of half a cell, twelve pixels, fits of six coefficients are the roundings' as much as the
  // light's (up to 1e-3 of distance).
  settings.coarseNarrowing = 0.4F;
  expectAgreement(settings, paths);
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

// To the left windows want paths, to the right they have them, and in between the coarse fit fades out. Of the limit of
// 20 x (1 / .15 - 1) = 113 paths a block's own four pixels have 4 and 400. Coarse windows do not narrow: see above.
TEST_F(BlockRegression, ConvergedBlocksAgreeWithBruteForce) {
  BlockRegressionSettings settings{
      .size = 2, .iterations = 1, .coarseSigma = kCoarseSigma, .coarseNarrowing = 0.0F, .coarseSamples = 20.0F};
  const auto paths = [](glm::ivec2 p) { return p.x < kSize.x / 2 ? 1.0 : 100.0; };
  for (const float least : {1e-6F, 0.15F, 0.4F}) {
    settings.coarseLeastShare = least;
    expectAgreement(settings, paths);
  }
}

// Where the light steps at a block's side, every block has its side's light, and none grows over the step. Pixels
// between the centres of blocks of either side are mixed.
TEST_F(BlockRegression, BlocksDoNotGrowOverAStepInTheLight) {
  const auto farthest = [&](float errors) {
    return farthestFromOwn(device(), {.size = 2, .iterations = 3, .growthErrors = errors, .coarseSamples = 0.0F},
                           [](int x) { return x < kStep - 1 || x > kStep; });
  };
  EXPECT_LE(farthest(8.5F), reference::kHalfRoundoff);
  EXPECT_GT(farthest(1e6F), 0.1);
}

// The same for cells. What lies within reach of the step has light of both sides in its window from the start, and a
// mean that is in doubt: only a strict test keeps those from joining others.
TEST_F(BlockRegression, CellsDoNotGrowOverAStepInTheLight) {
  constexpr int kReach = 6;  // Three standard deviations of half a cell of 2 pixels, half a cell and the cells between.
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

TEST_F(BlockRegression, AConstantStaysWhatItIs) {
  const glm::dvec3 light(0.25, 3.0, 1000.0);
  RegressionRun run(device(), {.size = 2, .iterations = 2});
  for (const NamedScene& scene : allScenes()) {
    Inputs inputs = inputsOf(scene.scene);
    for (glm::dvec4& sample : inputs.accumulated.pixels()) sample = glm::dvec4(light, 1.0);
    const Image<glm::dvec4> actual = run.filter(inputs);
    // Means of equal halves are merged about the first of them, so that nothing but single precision rounds: the
    // constant of a fit and the mixing of eight of them.
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(actual[p][c], light[c], halfTolerance(light[c], 64.0 * reference::kFloatRoundoff * light[c]))
            << scene.name << " " << p.x << " " << p.y;
    });
  }
}

/// The ridge r takes the slope s of a linear signal to (M + r)^-1 M s with the covariance M of a window, which misses
/// the signal, averaged over the window, by no more than sqrt(r) |s| / 2.
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
  const double rounding = 4.0 * reference::kHalfRoundoff * largest;  // Of the signal, the constant and the result.
  EXPECT_LE(std::sqrt(squares / double(signal.pixels().size())), 0.5 * std::sqrt(kRidge) * slopeLength + rounding);
}

TEST_F(BlockRegression, APowerOfTwoScalesTheOutput) {
  RegressionRun run(device(), {.size = 2, .iterations = 2});
  const auto scaled = [&](double factor) {
    Inputs inputs = inputsOf(sphere());
    for (glm::dvec4& sample : inputs.accumulated.pixels()) sample = glm::dvec4(factor * glm::dvec3(sample), sample.a);
    return run.filter(inputs);
  };
  // Radiance so high that covariances stay in the normal range of halves, and so low that no slope leaves it.
  const Image<glm::dvec4> before = scaled(16.0);
  const Image<glm::dvec4> after = scaled(128.0);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[p][c], 8.0 * before[p][c], halfTolerance(after[p][c], 0.0));
  });
}

TEST_F(BlockRegression, PixelsWithoutASampleHaveNoSay) {
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

TEST(BlockRegressionSettings, ThePlaneRampMustHaveALength) {
  fg::Graph graph;
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, {64, 64}});
  const BlockRegressionSettings settings{.planeNear = 0.1F, .planeFar = 0.1F};
  const auto add = [&] { addBlockRegression(graph, {}, {lighting, LightingAlpha::SampleCount}, {}, settings); };
  fg::test::expectError(add, {"blocks.plane-near"});
}

}  // namespace
}  // namespace walr::test
