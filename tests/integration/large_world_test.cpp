// Cameras far from the world's origin, with an origin of their own in every frame.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::large_world_test {
namespace {

using reference::HostFrame;
using Picture = reference::Image<glm::dvec4>;

constexpr glm::ivec2 kSize(66, 46);
constexpr std::uint32_t kFrames = 8;
const glm::dvec3 kNear(0.0);
const glm::dvec3 kFar(1e6, 2e5, -5e5);  // Metres: more than 1,000 km away.

/// The camera's rotation, which the scene does not know of: its world is rotated with it.
const glm::dmat4 kTurn = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 2.0, 0.5)));

/// Position of the camera in a frame, in the rotated world.
glm::dvec3 positionAt(double frame, glm::dvec3 place) {
  return place + glm::dvec3(glm::transpose(kTurn) * glm::dvec4(frame * glm::dvec3(0.05, 0.03, -0.04), 0.0));
}

/// How a host states where its cameras are.
enum class Origin : std::uint8_t { World, NearTheCamera };

/// The camera of a frame at a place in the world. Near the camera, the origin is a point of a grid of 4 units.
FrameDescription cameraOf(std::uint32_t frame, glm::dvec3 place, Origin stated) {
  FrameDescription camera = cameraAt(kNear, kNear, kSize, frame);
  const auto state = [&](double time, glm::mat4& view, glm::dvec3& origin) {
    const glm::dvec3 position = positionAt(time, place);
    // The grid's points are one apart every other frame, so that the origin moves.
    if (stated == Origin::NearTheCamera) origin = glm::floor(position) + glm::dvec3(int(time) % 2);
    view = glm::mat4(glm::translate(kTurn, origin - position));
  };
  state(frame, camera.view, camera.origin);
  state(frame > 0 ? frame - 1.0 : 0.0, camera.previousView, camera.previousOrigin);
  return camera;
}

class LargeWorld : public fg::test::GpuTest {
 protected:
  struct Outcome {
    Picture picture;
    std::vector<std::string> findings;
  };
  /// The last frame of a camera at a place; all motion comes from the cameras.
  Outcome denoise(glm::dvec3 place, Origin stated, bool remembered = false) const {
    HostedRun::Options options;
    options.rememberedCamera = remembered;
    options.lint = true;
    HostedRun run(device(), "walr", kSize, options);
    require(walr_set_setting(run.denoiser(), "scene.object-motion", "off"));
    std::vector<std::uint16_t> texels;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const auto at = [](double time) { return time * glm::dvec3(0.05, 0.03, -0.04); };
      const HostFrame frame = renderFrame(sphere(), cameraAt(at(i), at(i > 0 ? i - 1.0 : 0.0), kSize, i), kSize);
      run.fill(frame);
      texels = run.frame(cameraOf(i, place, stated));
    }
    Outcome outcome{decodeHalves(texels, kSize), {}};
    std::uint32_t count = 0;
    require(walr_get_findings(run.denoiser(), &count, nullptr));
    std::vector<WalrFinding> findings(count);
    require(walr_get_findings(run.denoiser(), &count, findings.data()));
    for (const WalrFinding& finding : findings) outcome.findings.emplace_back(finding.name);
    return outcome;
  }
};

/// Root mean square difference after the tone map x / (1 + x).
double difference(const Picture& a, const Picture& b) {
  double sum = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 x(a[p]);
    const glm::dvec3 y(b[p]);
    const glm::dvec3 d = x / (1.0 + x) - y / (1.0 + y);
    sum += glm::dot(d, d);
  });
  return std::sqrt(sum / (3.0 * kSize.x * kSize.y));
}

TEST_F(LargeWorld, AnOriginNearTheCameraGivesThePictureOfASmallWorld) {
  const Outcome small = denoise(kNear, Origin::World);
  EXPECT_EQ(small.findings, std::vector<std::string>{});
  // An origin changes how floats round the matrices, and does so in a small world, too.
  const double roundoff = difference(denoise(kNear, Origin::NearTheCamera).picture, small.picture);
  EXPECT_LT(roundoff, 1e-4);
  for (const bool remembered : {false, true}) {
    const Outcome large = denoise(kFar, Origin::NearTheCamera, remembered);
    EXPECT_EQ(large.findings, std::vector<std::string>{});
    RecordProperty("rmse", std::to_string(1e5 * difference(large.picture, small.picture)) + "e-5");
    EXPECT_LE(difference(large.picture, small.picture), 2.0 * roundoff);
  }
}

TEST_F(LargeWorld, MatricesOfALargeWorldAreFound) {
  const Outcome small = denoise(kNear, Origin::World);
  const Outcome large = denoise(kFar, Origin::World);
  // A hundred times what an origin changes.
  EXPECT_GT(difference(large.picture, small.picture), 1e-3);
  ASSERT_FALSE(large.findings.empty());
  EXPECT_EQ(large.findings.front(), "origin-far");
}

TEST_F(LargeWorld, AnOriginThatIsNoNumberIsRefused) {
  FrameDescription camera = cameraOf(0, kNear, Origin::World);
  camera.origin.y = std::numeric_limits<double>::infinity();
  HostedRun run(device(), "none", kSize);
  for (const char* image : {"lighting", "depth", "normal", "motion", "albedo"}) run.fill(image, {});
  EXPECT_THROW((void)run.frame(camera), std::runtime_error);
}

}  // namespace
}  // namespace walr::test::large_world_test
