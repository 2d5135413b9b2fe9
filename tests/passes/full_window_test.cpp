// REFWLR's filter on a device: it agrees with the double-precision reference and keeps its promises.

#include <cmath>
#include <vector>

#include "passes/regression/full_window_regression.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/hard_cases.h"
#include "tests/passes/reference/full_window.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::full_window_test {
namespace {

using reference::forEachPixel;
using reference::Guide;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(35, 26);         // More than the window of 27 pixels to one side only.
constexpr std::uint32_t kMostWindow = 105;  ///< Upper end of the setting's range.

/// A frame's lighting as temporal accumulation leaves it after the first frame.
Image<glm::dvec4> firstAccumulation(const HostFrame& frame) {
  Image<glm::dvec4> accumulated(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const glm::dvec3 l = glm::clamp(frame.lighting[p], glm::dvec3(0.0), glm::dvec3(reference::kLargestHalf));
    const bool sampled = std::isfinite(frame.lighting[p].r + frame.lighting[p].g + frame.lighting[p].b);
    accumulated[p] = sampled ? glm::dvec4(l, 1.0) : glm::dvec4(0.0);
  });
  return accumulated;
}

class FullWindowTest : public fg::test::GpuTest {
 protected:
  FilterRun makeRun(const FullWindowSettings& settings, glm::ivec2 size = kSize) {
    return {device(), size, 1,
            [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const std::vector<fg::Texture>& inputs) {
              const fg::Texture output = graph.texture("filtered", graph.textureDesc(inputs[0]));
              return addFullWindowRegression(graph, frame, inputs[0], guides, output, settings);
            }};
  }

  static void expectReference(FilterRun& run, const HostFrame& frame, const FullWindowSettings& settings) {
    const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
    const Image<glm::dvec4> accumulated = firstAccumulation(frame);
    const Image<glm::dvec4> actual = run.run(frame, guides, {accumulated});
    const Image<reference::WindowPixel> expected =
        reference::fullWindowRegression(frame, guides, accumulated, settings);
    Comparison comparison("full window");
    forEachPixel(frame.size(), [&](glm::ivec2 p) {
      const reference::WindowPixel& e = expected[p];
      if (comparison.skips(e.undecided)) return;
      comparison.colour(p, actual[p], e.fitted.colour, halfTolerance(e.fitted.colour, e.fitted.error));
    });
    // Undecided are pixels without a sample whose window has almost no weight.
    comparison.expect(kUndecidedShare);
  }
};

TEST_F(FullWindowTest, AgreesWithTheReferenceOnEveryScene) {
  FullWindowSettings paper{.window = 27};
  paper.edgeStopping.planeNormal = PlaneNormal::Shading;
  paper.edgeStopping.normalFactor = false;
  paper.regularisation = {.method = Regularisation::Floor, .ridge = 2e-3F};
  for (const FullWindowSettings& settings : {FullWindowSettings{.window = 27}, paper}) {
    FilterRun run = makeRun(settings);
    for (const NamedScene& named : allScenes()) {
      SCOPED_TRACE(named.name);
      expectReference(run, renderStill(named.scene, kSize), settings);
    }
  }
}

TEST_F(FullWindowTest, AgreesWithTheReferenceOnHardCases) {
  const FullWindowSettings settings{.window = 13};
  const std::vector<HardCase> cases = hardCases();
  FilterRun run = makeRun(settings, cases.front().frames.front().size());
  for (const HardCase& hard : cases) {
    SCOPED_TRACE(hard.name);
    expectReference(run, hard.frames.front(), settings);
  }
}

TEST_F(FullWindowTest, AgreesWithTheReferenceAtOddSizesAndInTheLargestWindow) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 5), glm::ivec2(37, 1), glm::ivec2(13, 9)}) {
    SCOPED_TRACE(std::to_string(size.x) + " x " + std::to_string(size.y));
    for (const std::uint32_t window : {1U, 3U, kMostWindow}) {
      const FullWindowSettings settings{.window = window};
      FilterRun run = makeRun(settings, size);
      expectReference(run, renderStill(bumpyWall(0.1), size), settings);
    }
  }
}

/// On a flat wall all features and all weights are equal, so a pixel whose window is the whole image gets the image's
/// mean.
void expectMean(FilterRun& run, glm::ivec2 size) {
  const HostFrame frame = renderStill(flatWall(), size);
  const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
  const Image<glm::dvec4> accumulated = firstAccumulation(frame);
  const Image<glm::dvec4> actual = run.run(frame, guides, {accumulated});
  glm::dvec3 mean(0.0);
  glm::dvec3 largest(0.0);
  for (const glm::dvec4& v : accumulated.pixels()) {
    mean += glm::dvec3(v) / double(size.x * size.y);
    largest = glm::max(largest, glm::dvec3(v));
  }
  // Error of the additions along a row and of the rows, for differences from the centre.
  const double roundings = (size.x + size.y + 7.0) * reference::kFloatRoundoff;
  const int reach = int(kMostWindow) / 2;
  forEachPixel(size, [&](glm::ivec2 p) {
    if (std::max({p.x, size.x - 1 - p.x, p.y, size.y - 1 - p.y}) > reach) return;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(actual[p][c], mean[c], halfTolerance(mean[c], roundings * largest[c])) << p.x << ", " << p.y;
  });
}

// A pixel in the middle has 177,120 weights, and none may be left out.
TEST_F(FullWindowTest, AveragesTheWholeOfTheLargestWindowOfWalr) {
  constexpr glm::ivec2 kWhole(81, 81);
  FilterRun run = makeRun({.window = kMostWindow}, kWhole);
  expectMean(run, kWhole);
}

// The image has two tiles.
TEST_F(FullWindowTest, TilesMeetWithoutSeams) {
  constexpr glm::ivec2 kWide(kMostWindow / 2 * 3, 7);
  ASSERT_LT(fullWindowTile(kMostWindow), std::uint32_t(kWide.x));
  FilterRun run = makeRun({.window = kMostWindow}, kWide);
  const HostFrame frame = renderStill(sphere(), kWide);
  expectReference(run, frame, {.window = kMostWindow});
}

TEST_F(FullWindowTest, DispatchesStayWithinTheirBound) {
  for (std::uint32_t window = 1; window <= kMostWindow; window += 2) {
    const std::uint64_t tile = fullWindowTile(window);
    std::uint64_t weights = 0;
    const int r = int(window) / 2;
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) weights += std::uint64_t(std::max(std::abs(x), std::abs(y)));
    EXPECT_LE(tile * tile * weights, kMostWeightsPerDispatch) << window;
    EXPECT_EQ(tile % 8, 0U);
  }
}

TEST_F(FullWindowTest, KeepsConstantLightAndPixelsWithoutASurface) {
  const glm::dvec3 constant(0.75, 0.5, 1.25);
  FilterRun run = makeRun({.window = 27});
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    HostFrame frame = renderStill(named.scene, kSize);
    const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const bool surface = guides[p].depth > 0.0;
      frame.lighting[p] = surface ? constant : glm::dvec3(reference::roundToHalf(0.01 * p.x), 3.0, 0x1p-20);
      if (surface && (p.x * 7 + p.y * 13) % 10 == 0) frame.lighting[p].g = NAN;
    });
    const Image<glm::dvec4> actual = run.run(frame, guides, {firstAccumulation(frame)});
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const bool surface = guides[p].depth > 0.0;
      // Black where the window has no sample.
      if (surface && !std::isfinite(frame.lighting[p].g) && glm::dvec3(actual[p]) == glm::dvec3(0.0)) return;
      for (int c = 0; c < 3; ++c) {
        const double expected = frame.lighting[p][c];
        if (surface) {
          EXPECT_NEAR(actual[p][c], constant[c], halfTolerance(constant[c], 0.0)) << p.x << ", " << p.y;
        } else {
          EXPECT_EQ(actual[p][c], expected) << p.x << ", " << p.y;
        }
      }
    });
  }
}

TEST_F(FullWindowTest, EvenWindowsAreRefused) {
  EXPECT_THROW((void)makeRun({.window = 26}), std::invalid_argument);
}

}  // namespace
}  // namespace walr::test::full_window_test
