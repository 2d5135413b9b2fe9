// Orthographic cameras: history lies where the host's motion says, and pictures are as good as those of a perspective
// camera.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passes/methods/denoiser.h"
#include "tests/error_text.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::orthographic_test {
namespace {

using fg::test::expectError;
using reference::forEachPixel;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(98, 66);
constexpr double kHeight = 5.0;  ///< As much as a perspective camera shows at the depth of the scenes.

HostedRun::Options orthographic() {
  HostedRun::Options options;
  options.conventions.orthographic = VK_TRUE;
  return options;
}

class Orthographic : public fg::test::GpuTest {};

// Without motion of objects, too: the motion of pixels cannot be computed from the stand-in's cameras.
TEST_F(Orthographic, HistoryGrowsEverywhereWhereTheCameraMovesByWholePixels) {
  // Light is constant and changes in the last frame: with history length n, the mean covers 1 / (n + 1) of the way.
  constexpr double kAfter = 1.875;
  constexpr int kLast = 6;
  constexpr double kStep = kHeight / kSize.y;
  for (const auto& [scene, objectMotion] :
       {std::pair(flatWall(), "on"), std::pair(stairs(), "on"), std::pair(stairs(), "off")}) {
    SCOPED_TRACE(objectMotion);
    HostedRun run(device(), "accumulate", kSize, orthographic());
    require(walr_set_setting(run.denoiser(), "scene.object-motion", objectMotion));
    std::vector<std::uint16_t> texels;
    for (int i = 0; i <= kLast; ++i) {
      const FrameDescription camera = orthographicCameraAt({kStep * i, 0.0, 0.0}, {kStep * (i - 1), 0.0, 0.0}, kSize,
                                                           static_cast<std::uint32_t>(i), kHeight);
      const Light light = [i](glm::dvec3, glm::dvec3) { return glm::dvec3(i < kLast ? 1.0 : kAfter); };
      const HostFrame frame = renderFrame(scene, camera, kSize, light, Noise::None);
      run.fill(frame);
      texels = run.frame(camera);
    }
    const Image<glm::dvec4> picture = decodeHalves(texels, kSize);
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const int frames = std::min(kLast, kSize.x - 1 - p.x);  // Since it came into view on the right.
      const double expected = 1.0 + (kAfter - 1.0) / (frames + 1.0);
      const double reach = reference::packedStep(expected, reference::kFilteredBits) + 0x1p-8;
      ASSERT_NEAR(picture[p].x, expected, reach) << p.x << ", " << p.y;
    });
  }
}

/// A panel in front of a wall, both facing the camera. In the second frame the panel is gone.
Scene panelInFront(double distance, bool there) {
  return [=](glm::dvec3 origin, glm::dvec3 /*direction*/) -> std::optional<SceneHit> {
    const bool onPanel = there && std::abs(origin.x) < 1.0;
    return SceneHit{origin.z + 5.0 - (onPanel ? distance : 0.0), {0.0, 0.0, 1.0}};
  };
}

TEST_F(Orthographic, TolerancesAreRelativeToTheDistanceFromTheStandIn) {
  // It is 16 behind the camera, and the wall is 5 in front of it: accumulation.plane-tolerance of 1 % is 0.21.
  constexpr double kOnPanel = 1.875;
  for (const auto& [distance, accepted] : {std::pair(0.18, true), std::pair(0.24, false)}) {
    HostedRun run(device(), "accumulate", kSize, orthographic());
    std::vector<std::uint16_t> texels;
    for (const bool there : {true, false}) {
      const FrameDescription camera = orthographicCameraAt({}, {}, kSize, there ? 0 : 1, kHeight);
      const Light light = [there](glm::dvec3, glm::dvec3) { return glm::dvec3(there ? kOnPanel : 1.0); };
      run.fill(renderFrame(panelInFront(distance, there), camera, kSize, light, Noise::None));
      texels = run.frame(camera);
    }
    const double expected = accepted ? 0.5 * (1.0 + kOnPanel) : 1.0;
    const double reach = reference::packedStep(expected, reference::kFilteredBits);
    EXPECT_NEAR(decodeHalves(texels, kSize)[kSize / 2].x, expected, reach) << distance;
  }
}

constexpr std::uint32_t kSeeds = 4;

/// A camera that moves in all directions, perspective or orthographic.
FrameDescription walkingCamera(bool parallel, std::uint32_t frame, std::uint32_t seed = 0) {
  const auto at = [](double time) { return glm::dvec3(0.05 * time, 0.02 * time, -0.03 * time); };
  const glm::dvec3 now = at(frame);
  const glm::dvec3 before = at(frame - 1.0);
  const std::uint32_t index = 100 * seed + frame;
  return parallel ? orthographicCameraAt(now, before, kSize, index, kHeight) : cameraAt(now, before, kSize, index);
}

/// Root mean square errors, relative to the light, of the last frame of a walk with several seeds of the noise.
std::vector<double> errorsOf(const fg::test::TestDevice& device, const Scene& scene, const std::string& method,
                             bool parallel) {
  constexpr std::uint32_t kFrames = 5;
  HostedRun run(device, method.c_str(), kSize, parallel ? orthographic() : HostedRun::Options{});
  std::vector<double> errors;
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    std::vector<std::uint16_t> texels;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const FrameDescription camera = walkingCamera(parallel, i, seed);
      run.fill(renderFrame(scene, camera, kSize));
      texels = run.frame(camera, i == 0 ? std::uint32_t{WALR_FRAME_RESET_HISTORY} : 0U);
    }
    const Image<glm::dvec4> result = decodeHalves(texels, kSize);
    const HostFrame truth =
        renderFrame(scene, walkingCamera(parallel, kFrames - 1, seed), kSize, smoothLight, Noise::None);
    double sum = 0.0;
    int count = 0;
    forEachPixel(kSize, [&](glm::ivec2 p) {
      if (truth.depth[p] >= 1e9) return;
      sum += std::pow((result[p].y - truth.lighting[p].y) / truth.lighting[p].y, 2);
      ++count;
    });
    errors.push_back(std::sqrt(sum / count));
  }
  return errors;
}

struct Estimate {
  double mean = 0.0;
  double variance = 0.0;  ///< Of the mean.
};
Estimate estimate(const std::vector<double>& errors) {
  Estimate result;
  for (const double error : errors) result.mean += error / kSeeds;
  for (const double error : errors) result.variance += std::pow(error - result.mean, 2) / (kSeeds - 1) / kSeeds;
  return result;
}

/// The error may exceed that of a perspective camera by three standard deviations of the noise.
void expectErrorOfPerspective(const fg::test::TestDevice& device, const Scene& scene, const std::string& method) {
  const Estimate perspective = estimate(errorsOf(device, scene, method, false));
  const Estimate parallel = estimate(errorsOf(device, scene, method, true));
  EXPECT_LE(parallel.mean, perspective.mean + 3.0 * std::sqrt(perspective.variance + parallel.variance));
}

TEST_F(Orthographic, TheErrorIsThatOfAPerspectiveCamera) {
  for (const NamedScene& each : {NamedScene{"flat wall", flatWall()}, NamedScene{"bumpy wall", bumpyWall(0.1)},
                                 NamedScene{"stairs", stairs()}}) {
    SCOPED_TRACE(each.name);
    expectErrorOfPerspective(device(), each.scene, "walr");
  }
}

class OrthographicMethod : public Orthographic, public testing::WithParamInterface<std::string> {};

TEST_P(OrthographicMethod, HasTheErrorOfAPerspectiveCamera) {
  expectErrorOfPerspective(device(), sphere(), GetParam());
}
INSTANTIATE_TEST_SUITE_P(Methods, OrthographicMethod, testing::ValuesIn(denoiserNames()));

TEST_F(Orthographic, DepthMayBeLinearNegativeOrThatOfTheDevice) {
  // The camera moves so far along its axis that depth of another scale fails the tests of the history.
  constexpr double kStep = 0.8;
  constexpr std::uint32_t kFrames = 4;
  std::vector<std::vector<std::uint16_t>> results;
  for (const WalrDepth kind : {WALR_DEPTH_LINEAR, WALR_DEPTH_NEGATIVE_LINEAR, WALR_DEPTH_DEVICE}) {
    HostedRun::Options options = orthographic();
    options.conventions.depth = kind;
    HostedRun run(device(), "accumulate", kSize, options);
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const auto at = [](double time) { return glm::dvec3(0.0, 0.0, kStep * time); };
      const FrameDescription camera = orthographicCameraAt(at(i), at(i - 1.0), kSize, i, kHeight);
      const HostFrame frame = renderFrame(skyBesideSurface(), camera, kSize);
      run.fill(frame);
      std::vector<float> depths = encodeFloats(frame.depth);
      for (float& depth : depths) {
        if (kind == WALR_DEPTH_NEGATIVE_LINEAR) depth = -depth;
        if (kind == WALR_DEPTH_DEVICE) depth = camera.projection[3][2] - camera.projection[2][2] * depth;
      }
      std::vector<std::byte> bytes(depths.size() * sizeof(float));
      std::memcpy(bytes.data(), depths.data(), bytes.size());
      run.fill("depth", bytes);
      const std::vector<std::uint16_t> texels = run.frame(camera);
      if (i + 1 < kFrames) continue;
      results.push_back(texels);
      const Image<glm::dvec4> picture = decodeHalves(texels, kSize);
      int unchanged = 0;
      forEachPixel(kSize, [&](glm::ivec2 p) {
        const bool passed = glm::dvec3(picture[p]) == frame.lighting[p];
        const bool sky = frame.depth[p] >= 1e9;
        EXPECT_TRUE(passed || !sky) << p.x << ", " << p.y;
        unchanged += !sky && passed && frame.lighting[p].x > 0.0 ? 1 : 0;
      });
      EXPECT_LT(unchanged, 10) << "history must be accepted";
    }
  }
  EXPECT_EQ(results[1], results[0]);
  EXPECT_EQ(results[2], results[0]);
}

TEST_F(Orthographic, WhatDoesNotFitIsRefusedWithTheWayOut) {
  const auto record = [&](bool stated, const glm::mat4& projection, WalrDepth depth = WALR_DEPTH_LINEAR) {
    HostedRun::Options options = stated ? orthographic() : HostedRun::Options{};
    options.conventions.depth = depth;
    HostedRun run(device(), "walr", kSize, options);
    FrameDescription camera = walkingCamera(true, 0);
    run.fill(renderFrame(flatWall(), camera, kSize));
    camera.projection = camera.previousProjection = projection;
    run.frame(camera);
  };
  const glm::mat4 parallel = walkingCamera(true, 0).projection;
  glm::mat4 oblique = parallel;
  oblique[2][0] = 0.1F;
  glm::mat4 down = parallel;
  down[1][1] *= -1.0F;
  EXPECT_NO_THROW(record(true, parallel));
  expectError<std::runtime_error>([&] { record(false, parallel); },
                                  {"is orthographic", "WalrConventions::orthographic"});
  expectError<std::runtime_error>([&] { record(true, walkingCamera(false, 0).projection); },
                                  {"is not that of an orthographic camera", "use another denoiser"});
  expectError<std::runtime_error>([&] { record(true, oblique); }, {"oblique projections"});
  expectError<std::runtime_error>([&] { record(true, down); }, {"has y down"});
  glm::mat4 flat = parallel;
  flat[2][2] = 0.0F;
  EXPECT_NO_THROW(record(true, flat));
  expectError<std::runtime_error>([&] { record(true, flat, WALR_DEPTH_DEVICE); }, {"row z of the projection"});

  HostedRun::Options options = orthographic();
  options.lint = true;
  expectError<std::runtime_error>([&] { const HostedRun run(device(), "walr", kSize, options); },
                                  {"WALR_ERROR_INVALID_ARGUMENT", "linter"});
  options = orthographic();
  options.conventions.motion_depth = WALR_MOTION_DEPTH_STATIC_SCENE;
  expectError<std::runtime_error>([&] { const HostedRun run(device(), "walr", kSize, options); },
                                  {"WALR_ERROR_INVALID_ARGUMENT", "third channel of motion"});
}

}  // namespace
}  // namespace walr::test::orthographic_test
