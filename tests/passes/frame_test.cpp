#include "passes/frame.h"

#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace walr {
namespace {

constexpr fg::Extent kExtent{640, 360};

/// Single precision rounds each of the few operations of a projection by half a unit in the last place, 6e-8. With
/// coordinates of up to 640 pixels the error is about 1e-4 of a pixel.
constexpr double kPixelTolerance = 1e-3;

FrameDescription movingCamera() {
  FrameDescription frame;
  frame.view = glm::lookAt(glm::vec3(1.0F, 2.0F, 3.0F), glm::vec3(0.5F, 1.0F, -4.0F), glm::vec3(0.0F, 1.0F, 0.0F));
  frame.previousView =
      glm::lookAt(glm::vec3(0.8F, 2.1F, 3.2F), glm::vec3(0.5F, 1.0F, -4.0F), glm::vec3(0.0F, 1.0F, 0.0F));
  frame.projection = glm::perspective(0.9F, 640.0F / 360.0F, 0.1F, 100.0F);
  frame.projection[2][0] = 0.03F;  // Off centre, like that of a shifted lens.
  frame.projection[2][1] = -0.02F;
  frame.previousProjection = frame.projection;
  return frame;
}

/// Pixel position of a point, y down, by the definition of clip space.
glm::dvec2 project(const glm::mat4& projection, glm::vec3 viewPosition) {
  const glm::dvec4 clip = glm::dmat4(projection) * glm::dvec4(viewPosition, 1.0F);
  return {(0.5 + 0.5 * clip.x / clip.w) * kExtent.width, (0.5 - 0.5 * clip.y / clip.w) * kExtent.height};
}

glm::vec3 unproject(const glm::vec4& rayFromPixel, glm::vec2 pixel, float depth) {
  return depth * glm::vec3(pixel.x * rayFromPixel.x + rayFromPixel.z, pixel.y * rayFromPixel.y + rayFromPixel.w, -1.0F);
}

TEST(FrameConstants, ARayProjectsToItsPixel) {
  const FrameDescription frame = movingCamera();
  const FrameConstants constants = frameConstants(frame, kExtent);
  for (const glm::vec2 pixel : {glm::vec2(0.5F, 0.5F), glm::vec2(320.0F, 180.0F), glm::vec2(639.5F, 12.25F)}) {
    const glm::dvec2 projected = project(frame.projection, unproject(constants.rayFromPixel, pixel, 7.0F));
    EXPECT_NEAR(projected.x, pixel.x, kPixelTolerance);
    EXPECT_NEAR(projected.y, pixel.y, kPixelTolerance);
  }
}

TEST(FrameConstants, AJitteredRayPassesThroughTheDisplacedSample) {
  FrameDescription frame = movingCamera();
  frame.jitter = {0.25F, -0.4F};
  frame.previousJitter = {-0.1F, 0.3F};
  const FrameConstants constants = frameConstants(frame, kExtent);
  const glm::vec2 pixel(100.5F, 50.5F);
  const glm::dvec2 now = project(frame.projection, unproject(constants.rayFromPixel, pixel, 3.0F));
  const glm::dvec2 before = project(frame.projection, unproject(constants.previousRayFromPixel, pixel, 3.0F));
  EXPECT_NEAR(now.x, pixel.x + 0.25, kPixelTolerance);
  EXPECT_NEAR(now.y, pixel.y - 0.4, kPixelTolerance);
  EXPECT_NEAR(before.x, pixel.x - 0.1, kPixelTolerance);
  EXPECT_NEAR(before.y, pixel.y + 0.3, kPixelTolerance);
}

TEST(FrameConstants, AStillPointLandsWhereThePreviousCameraSawIt) {
  const FrameDescription frame = movingCamera();
  const FrameConstants constants = frameConstants(frame, kExtent);
  const glm::vec4 world(0.3F, 1.2F, -3.0F, 1.0F);
  const glm::vec4 expected = frame.previousView * world;
  const glm::vec4 actual = constants.previousViewFromView * (frame.view * world);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5F);  // A few roundings of coordinates near 8.
}

TEST(FrameConstants, MatricesThatCannotBeACameraAreRejected) {
  FrameDescription singular = movingCamera();
  singular.view = glm::mat4(0.0F);
  EXPECT_THROW((void)frameConstants(singular, kExtent), std::invalid_argument);
  FrameDescription orthographic = movingCamera();
  orthographic.projection = glm::ortho(-1.0F, 1.0F, -1.0F, 1.0F);
  EXPECT_THROW((void)frameConstants(orthographic, kExtent), std::invalid_argument);
  FrameDescription flat = movingCamera();
  flat.projection[0][0] = 0.0F;
  EXPECT_THROW((void)frameConstants(flat, kExtent), std::invalid_argument);
}

}  // namespace
}  // namespace walr
