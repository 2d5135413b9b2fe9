#include "passes/lint/input_linter.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "passes/lint/lint_judge.h"

namespace walr {
namespace {

/// Position of the projection's centre in the image, pixels.
glm::dvec2 centreOf(const glm::mat4& projection, fg::Extent extent) {
  return {-0.5 * double(projection[2][0]) * extent.width, 0.5 * double(projection[2][1]) * extent.height};
}

bool sameFocalLength(const glm::mat4& a, const glm::mat4& b) {
  constexpr double kRoundoff = 1e-5;
  return std::abs(double(a[0][0]) - double(b[0][0])) <= kRoundoff * std::abs(double(a[0][0])) &&
         std::abs(double(a[1][1]) - double(b[1][1])) <= kRoundoff * std::abs(double(a[1][1]));
}

}  // namespace

std::string LintFinding::text() const {
  return std::string(name) + ": " + what + ". Likeliest cause: " + std::string(cause) +
         ". Way out: " + std::string(wayOut) + ".";
}

void InputLinter::add(std::span<const std::uint32_t> words, const FrameDescription& camera, fg::Extent extent,
                      bool continues) {
  counts_.add(words, continues);
  LintFrame frame{.camera = camera,
                  .constants = frameConstants(camera, extent),
                  .size = {extent.width, extent.height},
                  .continues = continues,
                  .samples = lintSamples(words, extent, camera.skyDepth)};
  edges_.add(frame);
  normals_.add(frame);
  motion_.add(std::move(frame));
  if (continues) addProjections(camera, extent);
}

void InputLinter::addProjections(const FrameDescription& frame, fg::Extent extent) {
  ++cameras_;
  const glm::dvec2 shift = centreOf(frame.projection, extent) - centreOf(frame.previousProjection, extent);
  // Jitter moves the centre by less than two pixels between frames; lens shifts move it more slowly or farther. A
  // hundredth of a pixel is above the rounding of single-precision matrices.
  constexpr double kLeast = 0.01;
  constexpr double kMost = 2.0;
  if (!sameFocalLength(frame.projection, frame.previousProjection)) return;
  if (glm::length(shift) < kLeast || glm::length(shift) > kMost) return;
  ++shiftedCameras_;
  if (glm::length(shift) > glm::length(largestShift_)) largestShift_ = shift;
}

std::vector<LintFinding> InputLinter::findings() const {
  LintJudge judge(conventions_, counts_, edges_, normals_, motion_);
  if (2 * shiftedCameras_ > cameras_) {
    std::array<char, 64> shift{};
    std::snprintf(shift.data(), shift.size(), "(%.2f, %.2f)", largestShift_.x, largestShift_.y);
    judge.add({"jitter-in-matrices",
               "the projection's centre moves from frame to frame, by up to " + std::string(shift.data()) + " pixels",
               "jitter was left in the projection matrix",
               "hand over the projection without jitter, and the jitter by itself"});
  }
  judge.judgeOrigin();
  judge.judgeDepth();
  judge.judgeValues();
  judge.judgeNormals();
  judge.judgeMotion();
  // Where specular albedo differs, roughness may, and with it the light.
  if (!conventions_.specular) judge.judgeAlbedo();
  judge.judgeSpecularValues();
  judge.judgeLobes();
  judge.judgeReflectedDistance();
  judge.judgeReflectedMotion();
  return judge.take();
}

}  // namespace walr
