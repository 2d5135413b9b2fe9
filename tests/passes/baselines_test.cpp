// Promises that every denoiser keeps: unit gain, invalid pixels and samples ignored, finite output for any input, and a
// smaller error than temporal accumulation alone.
#include <cmath>
#include <ostream>
#include <string>

#include "tests/passes/denoiser_run.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::baselines_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(45, 37);

struct Case {
  const char* method;
  bool spatialOnly = false;
  std::string preset = {};  ///< Empty: none is chosen.
};

std::string textOf(const Case& c) {
  return std::string(c.method) + (c.preset.empty() ? "" : "_" + c.preset) + (c.spatialOnly ? "_spatial" : "");
}

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << textOf(c);
}

std::string caseName(const testing::TestParamInfo<Case>& info) {
  return textOf(info.param);
}

class DenoiserTest : public fg::test::GpuTest, public testing::WithParamInterface<Case> {
 protected:
  [[nodiscard]] static std::unique_ptr<Denoiser> makeCase() {
    std::unique_ptr<Denoiser> denoiser = makeDenoiser(GetParam().method);
    if (!GetParam().preset.empty()) denoiser->usePreset(GetParam().preset);
    if (GetParam().spatialOnly) denoiser->set("spatial-only", "on");
    return denoiser;
  }
};

FrameDescription walkingCamera(std::uint32_t frame, glm::ivec2 size) {
  const glm::dvec3 step(0.06, 0.02, -0.03);
  return cameraAt(double(frame) * step, (double(frame) - 1.0) * step, size, frame);
}

bool hits(glm::ivec2 p, std::uint32_t frame, std::uint32_t channel, double share) {
  return (reference::pcg4d({p, frame, channel}).x + 0.5) * 0x1p-32 < share;
}

/// Constant light, with a share of pixels that have no finite sample.
HostFrame constantFrame(const Scene& scene, std::uint32_t index, double light, double elsewhere, double share) {
  HostFrame frame = renderFrame(scene, walkingCamera(index, kSize), kSize);
  forEachPixel(kSize, [&](glm::ivec2 p) {
    const bool surface = reference::surfaceAt(frame, p, {}).depth > 0.0;
    frame.lighting[p] = glm::dvec3(surface ? light : elsewhere);
    if (surface && hits(p, index, 1, share)) frame.lighting[p].y = hits(p, index, 2, 0.5) ? NAN : INFINITY;
  });
  return frame;
}

TEST_P(DenoiserTest, KeepsConstantLightAndIgnoresPixelsWithoutASample) {
  constexpr double kLight = 0.75;
  constexpr double kElsewhere = 7.25;
  const std::unique_ptr<Denoiser> denoiser = makeCase();
  DenoiserRun run(device(), *denoiser, kSize);
  for (const auto& [name, scene] : allScenes()) {
    for (const double share : {0.1, 0.5}) {
      SCOPED_TRACE(std::string(name) + ", not sampled: " + std::to_string(share));
      run.reset();
      for (std::uint32_t i = 0; i < 3; ++i) {
        const HostFrame frame = constantFrame(scene, i, kLight, kElsewhere, share);
        const Image<glm::dvec4> result = run.frame(frame);
        forEachPixel(kSize, [&](glm::ivec2 p) {
          const bool surface = reference::surfaceAt(frame, p, {}).depth > 0.0;
          // These are averages of equal halves. Each of at most seven stages may round by half a step.
          const double tolerance = surface ? 7.0 * reference::kHalfRoundoff * kLight : 0.0;
          const bool dark = surface && glm::dvec3(result[p]) == glm::dvec3(0.0);
          if (dark && !std::isfinite(frame.lighting[p].y)) return;  // The surface has no sample within reach.
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(result[p][c], surface ? kLight : kElsewhere, tolerance) << "at (" << p.x << ", " << p.y << ")";
        });
      }
    }
  }
}

TEST_P(DenoiserTest, IsFiniteForAnyInputAndSize) {
  // Mesa's CPU device compiles a shader again for textures whose sides are powers of two. So the smallest sizes, a
  // pixel, a column and a row, are all of that kind.
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(1, 4), glm::ivec2(8, 1), glm::ivec2(35, 33), kSize}) {
    const std::unique_ptr<Denoiser> denoiser = makeCase();
    DenoiserRun run(device(), *denoiser, size);
    for (std::uint32_t i = 0; i < 3; ++i) {
      HostFrame frame = renderFrame(stairs(), walkingCamera(i, size), size);
      constexpr double kHostile[] = {NAN, INFINITY, -INFINITY, 65504.0, -65504.0, 0.0, 0x1p-24};
      forEachPixel(size, [&](glm::ivec2 p) {
        const double value = kHostile[reference::pcg4d({p, i, 9U}).x % std::size(kHostile)];
        if (hits(p, i, 3, 0.1)) frame.lighting[p].x = value;
        if (hits(p, i, 4, 0.05)) frame.depth[p] = value;
        if (hits(p, i, 5, 0.05)) frame.normal[p].y = value;
        if (hits(p, i, 6, 0.05)) frame.motion[p].x = value;
        if (hits(p, i, 7, 0.05)) frame.motion[p].z = value;
        if (hits(p, i, 8, 0.05)) frame.albedo[p].z = value;
      });
      const Image<glm::dvec4> result = run.frame(frame);
      for (const glm::dvec4& pixel : result.pixels())
        for (int c = 0; c < 4; ++c)
          ASSERT_TRUE(std::isfinite(pixel[c])) << size.x << " x " << size.y << ", frame " << i;
    }
  }
}

class BaselineTest : public DenoiserTest {};

TEST_P(BaselineTest, BeatsAccumulationAlone) {
  const std::unique_ptr<Denoiser> denoiser = makeCase();
  const std::unique_ptr<Denoiser> accumulation = makeDenoiser("accumulate");
  DenoiserRun run(device(), *denoiser, kSize);
  DenoiserRun plainRun(device(), *accumulation, kSize);
  for (const auto& [name, scene] : allScenes()) {
    SCOPED_TRACE(name);
    run.reset();
    plainRun.reset();
    const std::uint32_t frames = GetParam().spatialOnly ? 1 : 6;
    double error = 0.0;
    double plainError = 0.0;
    for (std::uint32_t i = 0; i < frames; ++i) {
      const HostFrame noisy = renderFrame(scene, walkingCamera(i, kSize), kSize);
      const HostFrame truth = renderFrame(scene, walkingCamera(i, kSize), kSize, smoothLight, Noise::None);
      error = surfaceError(run.frame(noisy), truth);
      plainError = surfaceError(plainRun.frame(noisy), truth);
    }
    RecordProperty(std::string(name) + "_error", std::to_string(error));
    EXPECT_LT(error, 0.5 * plainError) << "error " << error << ", accumulation alone " << plainError;
  }
}

// The raw moments of walr_paper's preset paper keep constants only where features do not vary; tests of WALR cover it.
INSTANTIATE_TEST_SUITE_P(Methods, DenoiserTest,
                         testing::Values(Case{"svgf"}, Case{"svgf", true}, Case{"joint_bilateral"},
                                         Case{"joint_bilateral", true}, Case{"bmfr"}, Case{"bmfr", true}, Case{"flr"},
                                         Case{"flr", true}, Case{"flnr"}, Case{"flnr", true},
                                         Case{"flnr", false, "paper"}, Case{"flnr", true, "paper"}, Case{"walr"},
                                         Case{"walr", true}, Case{"accumulate"}),
                         caseName);
INSTANTIATE_TEST_SUITE_P(Methods, BaselineTest,
                         testing::Values(Case{"svgf"}, Case{"svgf", true}, Case{"joint_bilateral"},
                                         Case{"joint_bilateral", true}, Case{"bmfr"}, Case{"bmfr", true}, Case{"flr"},
                                         Case{"flr", true}, Case{"flnr"}, Case{"flnr", true},
                                         Case{"flnr", false, "paper"}, Case{"flnr", true, "paper"}, Case{"walr"},
                                         Case{"walr", true}),
                         caseName);

}  // namespace
}  // namespace walr::test::baselines_test
