// The joint bilateral filter on a device: it agrees with the double-precision reference and with plain averages.
#include <cmath>

#include "passes/filters/joint_bilateral_filter.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/joint_bilateral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::joint_bilateral_test {
namespace {

using reference::forEachPixel;
using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::kFloatRoundoff;

constexpr glm::ivec2 kSize(45, 31);
constexpr float kInfinity = JointBilateralFilterSettings::kInfinity;

/// Largest relative error of a weight in single precision. Vulkan allows an arc sine an error of 4096 units in the last
/// place. Its square has twice that, and a weight changes by at most 1 / e of it. The vector between two neighbours, a
/// hundredth of their depth long, errs by about eight roundings of a position; its sine errs by that over the vector's
/// length, relative to `sigmaPlane`. The rest is a hundred roundings.
double weightError(const JointBilateralFilterSettings& settings) {
  return 2.0 * 4096.0 * 0x1p-23 / std::exp(1.0) + 8.0 * kFloatRoundoff * 100.0 / double(settings.sigmaPlane) +
         100.0 * kFloatRoundoff;
}

class JointBilateralTest : public fg::test::GpuTest {
 protected:
  FilterRun filter(const JointBilateralFilterSettings& settings, glm::ivec2 size = kSize) {
    return {device(), size, 1,
            [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const std::vector<fg::Texture>& inputs) {
              const fg::Texture target = graph.texture("filtered", graph.textureDesc(inputs[0]));
              return addJointBilateralFilter(graph, frame, inputs[0], guides, target, settings);
            }};
  }
};

TEST_F(JointBilateralTest, AgreesWithTheReference) {
  JointBilateralFilterSettings settings;
  settings.radius = 5;
  for (const float sigmaColour : {kInfinity, 2.0F}) {
    settings.sigmaColour = sigmaColour;
    FilterRun run = filter(settings);
    for (const auto& [name, scene] : allScenes()) {
      SCOPED_TRACE(name);
      HostFrame frame = renderStill(scene, kSize);
      frame.lighting[{12, 11}].x = NAN;
      frame.lighting[{13, 11}].y = INFINITY;
      const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
      const Image<glm::dvec4> result = run.run(frame, guides, {withAlpha(frame.lighting)});
      const Image<reference::BilateralPixel> expected = reference::jointBilateral(frame, guides, settings);
      forEachPixel(kSize, [&](glm::ivec2 p) {
        const reference::BilateralPixel& e = expected[p];
        for (int c = 0; c < 3; ++c) {
          const double tolerance = 2.0 * weightError(settings) * e.spread[c] + 256.0 * kFloatRoundoff * e.colour[c] +
                                   halfTolerance(e.colour[c], 0.0);
          EXPECT_NEAR(result[p][c], e.colour[c], tolerance) << "at (" << p.x << ", " << p.y << ")";
        }
      });
    }
  }
}

TEST_F(JointBilateralTest, InfiniteSigmasGiveABoxAverageOrAGaussian) {
  const HostFrame frame = renderStill(flatWall(), kSize);
  const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
  for (const float sigmaPosition : {kInfinity, 2.0F}) {
    const JointBilateralFilterSettings settings{.radius = 4,
                                                .sigmaPosition = sigmaPosition,
                                                .sigmaColour = kInfinity,
                                                .sigmaNormal = kInfinity,
                                                .sigmaPlane = kInfinity};
    const Image<glm::dvec4> result = filter(settings).run(frame, guides, {withAlpha(frame.lighting)});
    forEachPixel(kSize, [&](glm::ivec2 p) {
      glm::dvec3 sum(0.0);
      double weightSum = 0.0;
      for (int y = -4; y <= 4; ++y) {
        for (int x = -4; x <= 4; ++x) {
          const glm::ivec2 q = p + glm::ivec2(x, y);
          if (!frame.lighting.contains(q)) continue;
          const double weight = std::exp(-(x * x + y * y) / (2.0 * double(sigmaPosition) * double(sigmaPosition)));
          sum += weight * frame.lighting[q];
          weightSum += weight;
        }
      }
      for (int c = 0; c < 3; ++c) {
        // Exponentials err by 3 + 2 abs(x) units in the last place, with x at most 4, and each of 81 sums by half a
        // unit.
        const double mean = sum[c] / weightSum;
        EXPECT_NEAR(result[p][c], mean, halfTolerance(mean, 0.0) + (2.0 * 11.0 + 81.0) * 2.0 * kFloatRoundoff * mean);
      }
    });
  }
}

TEST_F(JointBilateralTest, WindowsWithoutASampleAreBlack) {
  HostFrame frame = renderStill(flatWall(), {7, 5});
  for (glm::dvec3& radiance : frame.lighting.pixels()) radiance = glm::dvec3(NAN);
  const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
  const Image<glm::dvec4> result = filter({}, frame.size()).run(frame, guides, {withAlpha(frame.lighting)});
  for (const glm::dvec4& pixel : result.pixels()) EXPECT_EQ(glm::dvec3(pixel), glm::dvec3(0.0));
}

}  // namespace
}  // namespace walr::test::joint_bilateral_test
