#include <cmath>
#include <memory>
#include <ostream>
#include <string>

#include "tests/passes/denoiser_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::regression_robustness_test {
namespace {

using reference::HostFrame;
using reference::Image;

struct Method {
  const char* name;
  const char* spatialOnly;
  std::string preset = {};  ///< Empty: none is chosen.
};

std::string textOf(const Method& method) {
  return std::string(method.name) + (method.preset.empty() ? "" : "_" + method.preset) +
         (std::string(method.spatialOnly) == "on" ? "_spatial" : "");
}

std::ostream& operator<<(std::ostream& out, const Method& method) {
  return out << textOf(method);
}

std::string testName(const testing::TestParamInfo<Method>& info) {
  return textOf(info.param);
}

class RegressionRobustness : public fg::test::GpuTest, public testing::WithParamInterface<Method> {
 protected:
  [[nodiscard]] static std::unique_ptr<Denoiser> makeMethod() {
    auto denoiser = makeDenoiser(GetParam().name);
    if (!GetParam().preset.empty()) denoiser->usePreset(GetParam().preset);
    denoiser->set("spatial-only", GetParam().spatialOnly);
    return denoiser;
  }
};

void expectFinite(const Image<glm::dvec4>& image, const std::string& what) {
  reference::forEachPixel(image.size(), [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(std::isfinite(image[p][c])) << what << ": " << p.x << " " << p.y;
      ASSERT_GE(image[p][c], 0.0) << what << ": " << p.x << " " << p.y;
    }
  });
}

TEST_P(RegressionRobustness, SkyIsUnchangedAndALoneSurfaceKeepsItsLight) {
  constexpr glm::ivec2 kSize(34, 33);
  constexpr glm::ivec2 kLone(20, 11);
  const std::unique_ptr<Denoiser> denoiser = makeMethod();
  DenoiserRun run(device(), *denoiser, kSize);
  HostFrame frame = renderStill(flatWall(), kSize);
  const double depth = frame.depth[kLone];
  frame.depth = Image<double>(kSize, 1e10);
  frame.depth[kLone] = depth;
  const Image<glm::dvec4> image = run.frame(frame);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    for (int c = 0; c < 3; ++c) {
      // The fit of a lone sample is the sample, up to the rounding of a solve and of the textures in between.
      const double tolerance = p == kLone ? 8.0 * reference::kHalfRoundoff * frame.lighting[p][c] : 0.0;
      EXPECT_NEAR(image[p][c], frame.lighting[p][c], tolerance) << p.x << " " << p.y;
    }
  });
}

TEST_P(RegressionRobustness, ExtremeValuesStayFinite) {
  constexpr glm::ivec2 kSize(40, 33);
  const std::unique_ptr<Denoiser> denoiser = makeMethod();
  DenoiserRun run(device(), *denoiser, kSize);
  const auto denoiseVariant = [&](const std::string& what, auto change) {
    HostFrame frame = renderStill(sphere(), kSize);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { change(frame, p); });
    expectFinite(run.frame(frame), what);
  };
  denoiseVariant("black", [](HostFrame& f, glm::ivec2 p) { f.lighting[p] = glm::dvec3(0.0); });
  denoiseVariant("dim", [](HostFrame& f, glm::ivec2 p) { f.lighting[p] *= 1e-6; });
  denoiseVariant("fireflies", [](HostFrame& f, glm::ivec2 p) {
    if ((p.x * 7 + p.y * 13) % 101 == 0) f.lighting[p] = glm::dvec3(60000.0, 65504.0, 10000.0);
  });
  denoiseVariant("near", [](HostFrame& f, glm::ivec2 p) { f.depth[p] *= 2e-4; });
  denoiseVariant("far", [](HostFrame& f, glm::ivec2 p) { f.depth[p] *= 2e5; });
  denoiseVariant("near and far", [](HostFrame& f, glm::ivec2 p) { f.depth[p] = (p.x + p.y) % 2 == 0 ? 1e-3 : 1e6; });
}

INSTANTIATE_TEST_SUITE_P(Methods, RegressionRobustness,
                         testing::Values(Method{"bmfr", "off"}, Method{"bmfr", "on"}, Method{"flr", "off"},
                                         Method{"flr", "on"}, Method{"flnr", "off"}, Method{"flnr", "on"},
                                         Method{"flnr", "off", "paper"}, Method{"flnr", "on", "paper"}),
                         testName);

}  // namespace
}  // namespace walr::test::regression_robustness_test
