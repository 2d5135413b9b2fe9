#include "passes/methods/flr.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>

#include "tests/error_text.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/flr.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::flr_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(45, 34);  // Not a multiple of the cell size.

/// Inputs of the regression.
struct Inputs {
  Inputs(const Scene& scene, const FlrRegressionSettings& settings) : frame(renderStill(scene, kSize)) {
    std::optional<AmbientOcclusionSettings> occlusion;
    if (settings.occlusionGuide) occlusion = kOcclusionInSmallImages;
    guides = reference::prepareGuides(frame, Storage::Quantised, {}, occlusion);
  }
  HostFrame frame;
  Image<Guide> guides;
};

/// The regression alone, with guides as input.
class RegressionRun {
 public:
  RegressionRun(const fg::test::TestDevice& device, const FlrRegressionSettings& settings)
      : run_(
            device, kSize, 1,
            [&](fg::Graph& graph, fg::Buffer, const Guides& guides, const auto& inputs) {
              const fg::Texture filtered = graph.texture("filtered", graph.textureDesc(inputs[0]));
              return addFlrRegression(graph, inputs[0], LightingAlpha::Unused, guides, filtered, settings);
            },
            settings.occlusionGuide) {}

  Image<glm::dvec4> filter(const Inputs& inputs, const Image<glm::dvec3>& lighting) {
    return run_.run({}, inputs.guides, {withAlpha(lighting)});
  }

 private:
  FilterRun run_;
};

class Flr : public fg::test::GpuTest {
 protected:
  void expectAgreement(const FlrRegressionSettings& settings) {
    RegressionRun run(device(), settings);
    for (const NamedScene& scene : allScenes()) {
      const Inputs inputs(scene.scene, settings);
      const Image<glm::dvec3>& lighting = inputs.frame.lighting;
      const auto expected = reference::flrRegression(inputs.guides, lighting, settings);
      const Image<glm::dvec4> actual = run.filter(inputs, lighting);
      Comparison comparison(scene.name);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        comparison.compared();
        comparison.colour(p, actual[p], expected[p].colour, halfTolerance(expected[p].colour, expected[p].error));
      });
      comparison.expect(0.0);
    }
  }
};

/// The reference sums every window pixel by pixel. With cells of one pixel it is brute-force weighted least squares.
TEST_F(Flr, CellsOfOnePixelAgreeWithBruteForce) {
  for (const bool occlusion : {false, true})
    expectAgreement({.factor = 1, .sigma = 2.0F, .reach = 2.0F, .occlusionGuide = occlusion});
}

TEST_F(Flr, DownsampledCellsAgreeWithTheReference) {
  for (const bool occlusion : {false, true}) expectAgreement({.occlusionGuide = occlusion});
}

TEST_F(Flr, EveryUpsamplingAgreesWithTheReference) {
  for (const FlrUpsampling upsampling : {FlrUpsampling::Nearest, FlrUpsampling::Bspline})
    expectAgreement({.upsampling = upsampling});
}

TEST_F(Flr, ConstantLightIsUnchanged) {
  const glm::dvec3 light(0.25, 3.0, 1000.0);
  const FlrRegressionSettings settings;
  RegressionRun run(device(), settings);
  const Inputs inputs(sphere(), settings);
  const Image<glm::dvec3> lighting(kSize, light);
  const auto bound = reference::flrRegression(inputs.guides, lighting, settings);
  const Image<glm::dvec4> actual = run.filter(inputs, lighting);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(actual[p][c], light[c], halfTolerance(light[c], bound[p].error[c])) << p.x << " " << p.y;
  });
}

/// A signal a + s.x is reproduced up to the effect of the ridge. With the covariance M of a window, the ridge r changes
/// the slope s to (M + r)^-1 M s. The mean error over the window is then at most sqrt(r) |s| / 2, since the largest
/// value of r^2 m / (m + r)^2 is r / 4.
TEST_F(Flr, ASignalLinearInTheGuidesIsReproduced) {
  constexpr double kRidge = 1e-6;
  const FlrRegressionSettings settings{.ridge = static_cast<float>(kRidge)};
  RegressionRun run(device(), settings);
  Inputs inputs(bumpyWall(0.1), settings);
  const glm::dvec3 slope(0.5, -1.0, 0.7);
  const double depthSlope = 3.0;
  const double occlusionSlope = -2.0;
  Image<glm::dvec3> signal(kSize);
  double inverseDepth = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    Guide& guide = inputs.guides[p];
    inverseDepth = std::max(inverseDepth, 1.0 / guide.depth);
    guide.occlusion =
        reference::roundToUnorm(0.5 + 0.3 * std::sin(0.9 * p.x) * std::cos(0.7 * p.y), reference::kUnorm8Step);
    signal[p] = glm::dvec3(4.0 + glm::dot(reference::octahedralDecode(guide.features), slope) +
                           depthSlope / guide.depth + occlusionSlope * guide.occlusion);
  });
  const Image<glm::dvec4> actual = run.filter(inputs, signal);
  double squares = 0.0;
  double largest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    squares += (actual[p].x - signal[p].x) * (actual[p].x - signal[p].x);
    largest = std::max(largest, signal[p].x);
  });
  // The ridge of the inverse depth is relative, as if that guide were divided by its mean.
  const double slopeLength = std::hypot(glm::length(glm::dvec4(slope, depthSlope * inverseDepth)), occlusionSlope);
  const double rounding = 4.0 * reference::kHalfRoundoff * largest;  // Signal and result are halves.
  EXPECT_LE(std::sqrt(squares / double(inputs.guides.pixels().size())),
            0.5 * std::sqrt(kRidge) * slopeLength + rounding);
}

TEST(FlrSettings, TooManyCellsAreRejectedWithTheSetting) {
  fg::Graph graph;
  const fg::Texture lighting = graph.texture("lighting", {VK_FORMAT_R16G16B16A16_SFLOAT, {3840, 2160}});
  const auto add = [&] { addFlrRegression(graph, lighting, LightingAlpha::Unused, {}, lighting, {.factor = 1}); };
  fg::test::expectError(add, {"regression.factor"});
}

}  // namespace
}  // namespace walr::test::flr_test
