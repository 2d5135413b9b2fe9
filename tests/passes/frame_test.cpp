#include "passes/conventions/frame.h"
#include "passes/conventions/orthographic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/error_text.h"

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

TEST(FrameConstants, AZoomKeepsThePreviousFramesRays) {
  FrameDescription frame = movingCamera();
  frame.projection[0][0] *= 1.25F;
  frame.projection[1][1] *= 1.25F;
  const FrameConstants constants = frameConstants(frame, kExtent);
  const glm::vec2 pixel(100.5F, 300.25F);
  const glm::dvec2 projected =
      project(frame.previousProjection, unproject(constants.previousRayFromPixel, pixel, 7.0F));
  EXPECT_NEAR(projected.x, pixel.x, kPixelTolerance);
  EXPECT_NEAR(projected.y, pixel.y, kPixelTolerance);
}

TEST(FrameConstants, ARayOfAnOrthographicCamerasStandInProjectsToItsPixel) {
  for (const float height : {0.01F, 3.0F, 3.3F, 700.0F}) {
    FrameDescription frame = movingCamera();
    frame.orthographic = true;
    frame.projection = frame.previousProjection =
        glm::ortho(-0.3F * height, 0.7F * height, -0.25F * height, 0.75F * height);
    const double away = standOff(frame.projection);
    EXPECT_EQ(std::exp2(std::round(std::log2(away))), away);
    EXPECT_GE(away, 2.5 * double(height) * (1.0 - 1e-6));
    EXPECT_LE(away, 5.0 * double(height) * (1.0 + 1e-6));
    const FrameConstants constants = frameConstants(frame, kExtent);
    EXPECT_FLOAT_EQ(constants.skyDepth, frame.skyDepth + float(away));
    // The stand-in shows the same image of the plane through the camera.
    const glm::vec2 pixel(100.5F, 300.25F);
    const glm::vec3 position = unproject(constants.rayFromPixel, pixel, float(away));
    const glm::dvec2 projected = project(frame.projection, position);
    EXPECT_NEAR(projected.x, pixel.x, kPixelTolerance);
    EXPECT_NEAR(projected.y, pixel.y, kPixelTolerance);
    // It is as far behind its own camera's previous place as the camera itself is.
    const glm::vec4 world(0.3F, 1.2F, -3.0F, 1.0F);
    const glm::vec4 behind(0.0F, 0.0F, float(away), 0.0F);
    const glm::vec4 actual = constants.previousViewFromView * (frame.view * world - behind);
    const glm::vec4 expected = frame.previousView * world - behind;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-6F * float(away) + 1e-5F);
  }
}

/// Largest difference of the elements of two matrices.
double largestDifference(const glm::mat4& a, const glm::mat4& b) {
  double largest = 0.0;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) largest = std::max(largest, std::abs(double(a[column][row]) - b[column][row]));
  return largest;
}

// With an origin that moves along, a camera in a large world is as exact as near the world's origin.
TEST(FrameConstants, AnOriginKeepsLargeWorldsExact) {
  const FrameDescription near = movingCamera();
  const glm::mat4 expected = frameConstants(near, kExtent).previousViewFromView;
  const glm::dvec3 place(1e6, -3e5, 2e6);
  FrameDescription far = near;
  far.origin = place + glm::dvec3(0.7, 2.3, 3.1);
  far.previousOrigin = place;
  const glm::dvec3 moved = far.origin - far.previousOrigin;
  far.view = glm::mat4(glm::translate(glm::dmat4(near.view), moved));
  // Floats round each element of the view matrix, and that of the result.
  constexpr double kRoundoff = 8.0 * 0x1p-24 * 4.0;
  EXPECT_LE(largestDifference(frameConstants(far, kExtent).previousViewFromView, expected), kRoundoff);
  far.previousOrigin += glm::dvec3(0.01, 0.0, 0.0);
  EXPECT_GT(largestDifference(frameConstants(far, kExtent).previousViewFromView, expected), 0.005);
}

TEST(FrameConstants, AnOriginBeyondDoublePrecisionIsRefused) {
  FrameDescription frame = movingCamera();
  frame.origin.x = 1e9;
  EXPECT_THROW(frameConstants(frame, kExtent), std::invalid_argument);
  frame.origin.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(frameConstants(frame, kExtent), std::invalid_argument);
  frame.origin.x = 1e8;
  EXPECT_NO_THROW(frameConstants(frame, kExtent));
}

TEST(FrameConstants, AJitteredRayPassesThroughTheDisplacedSample) {
  FrameDescription frame = movingCamera();
  frame.jitter = {0.25F, -0.4F};
  frame.previousJitter = {-0.1F, 0.3F};
  const FrameConstants constants = frameConstants(frame, kExtent);
  EXPECT_EQ(constants.jitter, frame.jitter);
  const glm::vec2 pixel(100.5F, 50.5F);
  const glm::dvec2 now = project(frame.projection, unproject(constants.rayFromPixel, pixel, 3.0F));
  const glm::dvec2 before = project(frame.projection, unproject(constants.previousRayFromPixel, pixel, 3.0F));
  EXPECT_NEAR(now.x, pixel.x + 0.25, kPixelTolerance);
  EXPECT_NEAR(now.y, pixel.y - 0.4, kPixelTolerance);
  EXPECT_NEAR(before.x, pixel.x - 0.1, kPixelTolerance);
  EXPECT_NEAR(before.y, pixel.y + 0.3, kPixelTolerance);
}

TEST(FrameConstants, AJitterOfMoreThanHalfAPixelMovesRaysButLeavesSamplesInTheirPixels) {
  FrameDescription frame = movingCamera();
  frame.jitter = {1.25F, -0.75F};
  const FrameConstants constants = frameConstants(frame, kExtent);
  EXPECT_EQ(constants.jitter, glm::vec2(0.5F, -0.5F));
  const glm::vec2 pixel(100.5F, 50.5F);
  const glm::dvec2 now = project(frame.projection, unproject(constants.rayFromPixel, pixel, 3.0F));
  EXPECT_NEAR(now.x, pixel.x + 1.25, kPixelTolerance);
  EXPECT_NEAR(now.y, pixel.y - 0.75, kPixelTolerance);
}

TEST(FrameConstants, AStillPointLandsWhereThePreviousCameraSawIt) {
  const FrameDescription frame = movingCamera();
  const FrameConstants constants = frameConstants(frame, kExtent);
  const glm::vec4 world(0.3F, 1.2F, -3.0F, 1.0F);
  const glm::vec4 expected = frame.previousView * world;
  const glm::vec4 actual = constants.previousViewFromView * (frame.view * world);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(actual[i], expected[i], 1e-5F);  // A few roundings of coordinates near 8.
}

/// A change to the matrices of a camera, and words of the message that refuses it.
struct WrongMatrix {
  const char* name;
  std::function<void(FrameDescription&)> spoil;
  const char* message;
};

void PrintTo(const WrongMatrix& wrong, std::ostream* out) {
  *out << wrong.name;
}

class WrongMatrices : public testing::TestWithParam<WrongMatrix> {};

TEST_P(WrongMatrices, AreRefusedWithTheLikelyCause) {
  FrameDescription frame = movingCamera();
  GetParam().spoil(frame);
  try {
    (void)frameConstants(frame, kExtent);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(GetParam().message), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    FrameConstants, WrongMatrices,
    testing::Values(
        WrongMatrix{"singular view", [](FrameDescription& f) { f.view = glm::scale(f.view, glm::vec3(1, 1, 0)); },
                    "view matrix is singular"},
        WrongMatrix{"transposed view", [](FrameDescription& f) { f.view = glm::transpose(f.view); },
                    "view matrix is transposed"},
        WrongMatrix{"view times projection", [](FrameDescription& f) { f.view = f.projection * f.view; },
                    "view matrix is not affine"},
        WrongMatrix{"view in other units", [](FrameDescription& f) { f.view = glm::scale(f.view, glm::vec3(100)); },
                    "view matrix scales"},
        WrongMatrix{"left-handed view",
                    [](FrameDescription& f) { f.view = glm::scale(glm::mat4(1), glm::vec3(1, 1, -1)) * f.view; },
                    "view matrix mirrors"},
        WrongMatrix{"sheared view", [](FrameDescription& f) { f.view[1] += 0.2F * f.view[0]; },
                    "view matrix is sheared"},
        WrongMatrix{"previous view in other units",
                    [](FrameDescription& f) { f.previousView = glm::scale(f.previousView, glm::vec3(0.01F)); },
                    "view matrix scales"},
        WrongMatrix{"view that is not finite",
                    [](FrameDescription& f) { f.view[3][0] = std::numeric_limits<float>::infinity(); },
                    "view matrix is not finite"},
        WrongMatrix{"orthographic", [](FrameDescription& f) { f.projection = glm::ortho(-1.0F, 1.0F, -1.0F, 1.0F); },
                    "orthographic"},
        WrongMatrix{"transposed projection", [](FrameDescription& f) { f.projection = glm::transpose(f.projection); },
                    "projection matrix is transposed"},
        WrongMatrix{"inverted projection", [](FrameDescription& f) { f.projection = glm::inverse(f.projection); },
                    "inverse matrix"},
        WrongMatrix{"view-projection", [](FrameDescription& f) { f.projection = f.projection * f.view; },
                    "a product with the view matrix"},
        WrongMatrix{"left-handed projection",
                    [](FrameDescription& f) { f.projection = glm::perspectiveLH(0.9F, 1.5F, 0.1F, 100.0F); },
                    "left-handed"},
        WrongMatrix{"y down", [](FrameDescription& f) { f.projection[1][1] *= -1.0F; }, "has y down"},
        WrongMatrix{"previous projection with y down", [](FrameDescription& f) { f.previousProjection[1][1] *= -1.0F; },
                    "has y down"},
        WrongMatrix{"x mirrored", [](FrameDescription& f) { f.projection[0][0] *= -1.0F; }, "mirrors x"},
        WrongMatrix{"no focal length", [](FrameDescription& f) { f.projection[0][0] = 0.0F; }, "focal length"},
        WrongMatrix{"rotated image",
                    [](FrameDescription& f) {
                      f.projection = glm::rotate(glm::mat4(1), 1.5707963F, glm::vec3(0, 0, 1)) * f.projection;
                    },
                    "rotates or shears"},
        WrongMatrix{"offset of an eye", [](FrameDescription& f) { f.projection[3][0] = 0.05F; }, "stereo"}));

TEST(FrameConstants, NumbersThatNoFrameHasAreRefused) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  struct Case {
    void (*change)(FrameDescription&);
    const char* text;
  };
  const Case cases[] = {
      {[](FrameDescription& f) { f.jitter.y = kNan; }, "jitter is not finite"},
      {[](FrameDescription& f) { f.previousJitter.x = std::numeric_limits<float>::infinity(); },
       "jitter is not finite"},
      {[](FrameDescription& f) { f.motionScale.x = kNan; }, "scale of motion is not finite"},
      {[](FrameDescription& f) { f.skyDepth = kNan; }, "sky's depth is not above 0"},
      {[](FrameDescription& f) { f.skyDepth = 0.0F; }, "sky's depth is not above 0"},
      {[](FrameDescription& f) {
         f.previousExtent = fg::Extent{0, 8};
       },
       "previous frame has no pixels"},
  };
  for (const Case& each : cases) {
    FrameDescription frame = movingCamera();
    each.change(frame);
    fg::test::expectError([&] { (void)frameConstants(frame, kExtent); }, {each.text});
  }
  FrameDescription frame = movingCamera();
  frame.skyDepth = std::numeric_limits<float>::infinity();
  EXPECT_NO_THROW((void)frameConstants(frame, kExtent)) << "nothing is sky";
}

TEST(FrameConstants, ProjectionsOfAllUsualKindsAreAccepted) {
  FrameDescription frame = movingCamera();
  // Reversed z with a far plane at infinity: row z is (0, 0, 0, near).
  frame.projection[2][2] = 0.0F;
  frame.projection[3][2] = 0.1F;
  EXPECT_NO_THROW((void)frameConstants(frame, kExtent));
  frame.projection[3][2] = 1.0F;  // A near plane at 1 makes the last column that of a transposed matrix.
  EXPECT_NO_THROW((void)frameConstants(frame, kExtent));
  frame.projection = glm::perspectiveRH_ZO(1.2F, 1.0F, 0.5F, 1e4F);
  EXPECT_NO_THROW((void)frameConstants(frame, kExtent));
  frame.projection = glm::frustum(-0.1F, 0.2F, -0.05F, 0.08F, 0.1F, 50.0F);
  EXPECT_NO_THROW((void)frameConstants(frame, kExtent));
  // Camera matrices of engines are products of rotations in single precision.
  for (int i = 0; i < 1000; ++i) frame.view = glm::rotate(frame.view, 0.1F, glm::normalize(glm::vec3(1, i % 7, 2)));
  EXPECT_NO_THROW((void)frameConstants(frame, kExtent));
}

}  // namespace
}  // namespace walr
