// Things that move while a mirror shows them, with their motion given (`DenoiserInputs::specularMotion`).

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vector_relational.hpp>

#include "passes/methods/denoiser.h"
#include "tests/passes/mirror_optics.h"
#include "tests/passes/reflection_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::moving_reflections_test {
namespace {

using reference::HostFrame;
using reference::Image;

/// The world's axes, as the camera sees them: the given motion is in world space.
const glm::dmat3 kTurn(glm::rotate(glm::dmat4(1.0), 1.1, glm::normalize(glm::dvec3(0.4, 0.7, -0.3))));

/// A frame of a scene that is given in the camera's axes.
HostFrame turnedFrame(const Scene& scene, FrameDescription camera, double distance, double roughness) {
  const auto turned = [&](glm::dvec3 origin, glm::dvec3 direction) {
    std::optional<SceneHit> hit = scene(origin * kTurn, direction * kTurn);
    if (!hit) return hit;
    hit->shadingNormal = kTurn * hit->shadingNormal;
    hit->moved = kTurn * hit->moved;
    return hit;
  };
  for (glm::mat4* view : {&camera.view, &camera.previousView})
    *view = glm::mat4(glm::dmat4(*view) * glm::dmat4(glm::transpose(kTurn)));
  return specularFrame(turned, camera, distance, roughness);
}

struct MovingCase {
  const char* name;
  Mirror mirror;
  double distance;
  double roughness;
  // Largest errors in pixels: see `OpticsCase` in reflection_motion_test.cpp, whose cases these are.
  double mean;
  double worst;        ///< Of 99 in 100.
  double share = 1.0;  ///< Of the motion: a concave mirror magnifies it, and with it the error of one step.
};

class MovingReflections : public fg::test::GpuTest {};

TEST_F(MovingReflections, AgreeWithOptics) {
  const MovingCase cases[]{
      {"flat", {kInfinity, 0.4}, 1.5, 0.08, 0.01, 0.02},
      // From the surface's place, 6.4 pixels away, one step of Newton's method ends .016 and .026 pixels off.
      {"flat, rough", {kInfinity, 0.4}, 1.5, 0.2, 0.02, 0.033},
      {"convex", {0.3, 0.4}, 1.0, 0.2, 0.03, 0.08},
      {"concave, before the focus", {-3.0, 0.3}, 0.5, 0.2, 0.12, 0.3, 0.15},
      {"mirror moves, too", {0.5, 0.4, 2.0, {0.015, 0.005, 0.0}}, 1.0, 0.2, 0.12, 0.3},
  };
  const glm::dvec3 step(0.006, -0.004, 0.003);
  const auto method = makeDenoiser("walr");
  ReflectionRun told(device(), *method, {.specularMotion = true});
  ReflectionRun untold(device(), *method);
  for (const MovingCase& c : cases) {
    SCOPED_TRACE(c.name);
    const glm::dvec3 moved = c.share * glm::dvec3(0.0075, 0.0125, -0.01);
    const Walk cameras = walk(step, true);
    HostFrame first = turnedFrame(c.mirror.before().scene(), cameras.first, c.distance, c.roughness);
    HostFrame second = turnedFrame(c.mirror.scene(), cameras.second, c.distance, c.roughness);
    first.specularMotion = second.specularMotion = Image<glm::dvec3>(kMirrorSize, kTurn * moved);
    std::vector<double> errors;
    double error = 0.0;
    for (ReflectionRun* const run : {&told, &untold}) {
      run->reset();
      run->frame(first);
      run->frame(second);
    }
    const Image<glm::dvec3> motion = told.view(0);
    const Image<glm::dvec3> still = untold.view(0);
    reference::forEachPixel(kMirrorSize, [&](glm::ivec2 p) {
      const auto exact = exactMotion(c.mirror, second, step, c.distance, p, moved);
      if (!exact) return;
      const glm::dvec2 inside = reference::pixelCentre(p) + *exact;
      if (glm::any(glm::lessThan(inside, glm::dvec2(8.0)))) return;
      if (glm::any(glm::greaterThan(inside, glm::dvec2(kMirrorSize) - 8.0))) return;
      errors.push_back(glm::distance(glm::dvec2(motion[p]), *exact));
      error += glm::distance(glm::dvec2(still[p]), *exact);
    });
    ASSERT_GT(errors.size(), 500U);
    const ErrorFigures figures = figuresOf(errors);
    const double untoldMean = error / static_cast<double>(errors.size());
    RecordProperty(c.name, figures.text() + ", untold " + std::to_string(untoldMean));
    EXPECT_LT(figures.mean, c.mean);
    EXPECT_LT(figures.worst, c.worst);
    EXPECT_GT(untoldMean, 5.0 * c.mean);
  }
}

}  // namespace
}  // namespace walr::test::moving_reflections_test
