// A host's mistakes in specular light, and in what it says of the things that mirrors show, are found in the C API.
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "integration/include/walr/specular_albedo.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::specular_lint_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(80, 60);
constexpr glm::dvec3 kStep(0.25, 0.0, 0.125);  ///< Of the panel, each frame.
constexpr double kFloor = -1.0;
constexpr double kRoughness = 178.0 / 255.0;

/// A wall, and before it a panel that moves over a floor.
std::optional<SceneHit> room(glm::dvec3 origin, glm::dvec3 direction) {
  std::optional<SceneHit> nearest;
  const auto add = [&](double distance, glm::dvec3 normal, glm::dvec3 moved) {
    if (distance > 1e-6 && (!nearest || distance < nearest->distance)) {
      nearest = SceneHit{.distance = distance, .shadingNormal = normal, .moved = moved};
    }
  };
  add((kFloor - origin.y) / direction.y, {0.0, 1.0, 0.0}, {});
  add((-6.0 - origin.z) / direction.z, {0.0, 0.0, 1.0}, {});
  const double toPanel = (-4.5 - origin.z) / direction.z;
  const glm::dvec3 onPanel = origin + toPanel * direction;
  if (std::abs(onPanel.x) < 0.8 && std::abs(onPanel.y + 0.4) < 0.4) add(toPanel, {0.0, 0.0, 1.0}, kStep);
  return nearest;
}

/// The room with a floor that is a mirror; all else is a rough dielectric.
HostFrame mirrored(const FrameDescription& camera, glm::dvec3 eye) {
  HostFrame frame = asSpecular(renderFrame(room, camera, kSize, smoothLight, Noise::None), 1.0, kRoughness);
  frame.specularMotion = Image<glm::dvec3>(kSize, glm::dvec3(0.0));
  const glm::vec4 rays = frame.constants.rayFromPixel;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec2 slope = (glm::dvec2(p) + 0.5) * glm::dvec2(rays.x, rays.y) + glm::dvec2(rays.z, rays.w);
    const glm::dvec3 ray(slope, -1.0);
    const glm::dvec3 normal = frame.normal[p];
    const double cosine = glm::dot(normal, -glm::normalize(ray));
    frame.albedo[p] = glm::dvec3(walrSpecularAlbedo(0.04F, float(kRoughness), float(cosine)));
    frame.lightAlpha[p] = std::numeric_limits<double>::infinity();  // As 1e10 in halves.
    if (normal.y < 0.5) return;
    frame.roughness[p] = 0.0;
    const auto hit = room(eye + frame.depth[p] * ray, glm::reflect(glm::normalize(ray), normal));
    frame.lightAlpha[p] = hit ? hit->distance : std::numeric_limits<double>::infinity();
    frame.specularMotion[p] = hit ? -hit->moved : glm::dvec3(0.0);
  });
  return frame;
}

class SpecularLint : public fg::test::GpuTest {};

TEST_F(SpecularLint, FindsMistakesOfHosts) {
  struct Mistake {
    std::vector<std::string> findings;
    std::function<void(HostFrame&)> make;
  };
  const Mistake mistakes[] = {
      {{}, [](HostFrame&) {}},
      {{"specular-distance-of-another-ray"},
       [](HostFrame& frame) {
         for (double& distance : frame.lightAlpha.pixels()) distance *= 0.5;
       }},
      {{"specular-distance-mask"},
       [](HostFrame& frame) {
         for (double& distance : frame.lightAlpha.pixels()) distance = 1.0;
       }},
      // Kilometres beside metres.
      {{"specular-distance-short"},
       [](HostFrame& frame) {
         for (double& distance : frame.lightAlpha.pixels()) distance /= 1000.0;
       }},
      {{"specular-motion-sign"},
       [](HostFrame& frame) {
         for (glm::dvec3& motion : frame.specularMotion.pixels()) motion = -motion;
       }},
      {{"specular-motion-missing"},
       [](HostFrame& frame) { frame.specularMotion = Image<glm::dvec3>(kSize, glm::dvec3(0.0)); }},
      {{"roughness-encoding"},
       [](HostFrame& frame) {
         for (double& roughness : frame.roughness.pixels())
           roughness = std::round(255.0 * roughness * roughness) / 255.0;
       }},
      {{"specular-distance"},
       [](HostFrame& frame) {
         frame.lightAlpha[{9, 40}] = -1.0;
       }},
      {{"specular-not-finite"},
       [](HostFrame& frame) {
         frame.specularMotion[{9, 40}].y = std::numeric_limits<double>::quiet_NaN();
       }},
  };
  for (const Mistake& mistake : mistakes) {
    HostedRun run(device(), "accumulate", kSize, {.lint = true, .specularMotion = true, .specular = true});
    for (std::uint32_t i = 0; i < 4; ++i) {
      const auto eyeAt = [](double time) { return glm::dvec3(0.06, 0.02, -0.03) * time; };
      HostFrame frame = mirrored(cameraAt(eyeAt(i), eyeAt(double(i) - 1.0), kSize, i), eyeAt(i));
      mistake.make(frame);
      run.fill(frame);
      run.frame(cameraAt(eyeAt(i), eyeAt(double(i) - 1.0), kSize, i));
    }
    EXPECT_EQ(findingsOf(run.denoiser()), mistake.findings);
  }
}

}  // namespace
}  // namespace walr::test::specular_lint_test
