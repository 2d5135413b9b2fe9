#include "passes/flr.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>

#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/flr.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(45, 34);  // No multiple of a cell.

/// The regression alone, fed with guides.
class RegressionRun {
 public:
  RegressionRun(const fg::vk::Device& device, const FlrRegressionSettings& settings)
      : run_(device, kSize, 1, [&](fg::Graph& graph, fg::Buffer, const Guides& guides, const auto& inputs) {
          const fg::Texture filtered = graph.texture("filtered", graph.textureDesc(inputs[0]));
          return addFlrRegression(graph, inputs[0], LightingAlpha::Unused, guides, filtered, settings);
        }) {}

  Image<glm::dvec4> filter(const Image<Guide>& guides, const Image<glm::dvec3>& lighting) {
    return run_.run({}, guides, {withAlpha(lighting)});
  }

 private:
  FilterRun run_;
};

class Flr : public fg::test::GpuTest {
 protected:
  void expectAgreement(const FlrRegressionSettings& settings) {
    RegressionRun run(device(), settings);
    for (const NamedScene& scene : allScenes()) {
      const HostFrame frame = renderStill(scene.scene, kSize);
      const Image<Guide> guides = reference::prepareGuides(frame, Storage::Quantised);
      const auto expected = reference::flrRegression(guides, frame.lighting, settings);
      const Image<glm::dvec4> actual = run.filter(guides, frame.lighting);
      Comparison comparison(scene.name);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        comparison.compared();
        for (int c = 0; c < 3; ++c) {
          comparison.value(p, "colour", actual[p][c], expected[p].colour[c],
                           halfTolerance(expected[p].colour[c], expected[p].error[c]));
        }
      });
      comparison.expect(0.0);
    }
  }
};

/// The reference sums every window pixel by pixel: at one pixel a cell this is brute-force weighted least squares.
TEST_F(Flr, OnePixelACellIsBruteForceLeastSquares) {
  expectAgreement({.factor = 1, .sigma = 2.0F, .reach = 2.0F});
}

TEST_F(Flr, DownsampledCellsAgreeWithTheReference) {
  expectAgreement({});
}

TEST_F(Flr, AConstantStaysWhatItIs) {
  const glm::dvec3 light(0.25, 3.0, 1000.0);
  const FlrRegressionSettings settings;
  RegressionRun run(device(), settings);
  const Image<Guide> guides = reference::prepareGuides(renderStill(sphere(), kSize), Storage::Quantised);
  const Image<glm::dvec3> lighting(kSize, light);
  const auto bound = reference::flrRegression(guides, lighting, settings);
  const Image<glm::dvec4> actual = run.filter(guides, lighting);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(actual[p][c], light[c], halfTolerance(light[c], bound[p].error[c])) << p.x << " " << p.y;
  });
}

/// A signal a + s.x is reproduced up to the ridge: with the covariance M of a window, the ridge r takes the slope s to
/// (M + r)^-1 M s, which misses the signal, averaged over the window, by no more than sqrt(r) |s| / 2 (the largest
/// value of r^2 m / (m + r)^2 is r / 4).
TEST_F(Flr, ASignalLinearInTheGuidesIsReproduced) {
  constexpr double kRidge = 1e-6;
  RegressionRun run(device(), {.ridge = static_cast<float>(kRidge)});
  const Image<Guide> guides = reference::prepareGuides(renderStill(bumpyWall(0.1), kSize), Storage::Quantised);
  const glm::dvec3 slope(0.5, -1.0, 0.7);
  const double depthSlope = 3.0;
  Image<glm::dvec3> signal(kSize);
  double inverseDepth = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 n = reference::octahedralDecode(guides[p].features);
    inverseDepth = std::max(inverseDepth, 1.0 / guides[p].depth);
    signal[p] = glm::dvec3(4.0 + glm::dot(n, slope) + depthSlope / guides[p].depth);
  });
  const Image<glm::dvec4> actual = run.filter(guides, signal);
  double squares = 0.0;
  double largest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    squares += (actual[p].x - signal[p].x) * (actual[p].x - signal[p].x);
    largest = std::max(largest, signal[p].x);
  });
  // The ridge of the inverse depth is relative, which is as if the guide were measured in units of its mean.
  const double slopeLength = glm::length(glm::dvec4(slope, depthSlope * inverseDepth));
  const double rounding = 4.0 * reference::kHalfRoundoff * largest;  // Of the signal and of the result.
  EXPECT_LE(std::sqrt(squares / double(guides.pixels().size())), 0.5 * std::sqrt(kRidge) * slopeLength + rounding);
}

TEST(FlrSettings, TooManyCellsAreRejectedWithTheSetting) {
  fg::Graph graph;
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, {3840, 2160}});
  try {
    (void)addFlrRegression(graph, lighting, LightingAlpha::Unused, {}, lighting, {.factor = 1});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("regression.factor"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace walr::test
