#include "passes/conventions/orthographic.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace walr {
namespace {

/// Least stand-off in heights of the image: half of the image is then seen under atan(0.5 / 2.5) = 11 degrees.
constexpr double kLeastHeights = 2.5;

}  // namespace

bool isOrthographic(const glm::mat4& projection) {
  return projection[2][3] == 0.0F && projection[3][3] == 1.0F;
}

double standOff(const glm::mat4& projection) {
  const double height = 2.0 / double(projection[1][1]);
  return std::exp2(std::ceil(std::log2(kLeastHeights * height)));
}

glm::dmat4 standInProjection(const glm::mat4& projection) {
  const double distance = standOff(projection);
  glm::dmat4 result(0.0);
  result[0][0] = double(projection[0][0]) * distance;
  result[1][1] = double(projection[1][1]) * distance;
  // clip.w is -view.z here, and was 1.
  result[2][0] = -double(projection[3][0]);
  result[2][1] = -double(projection[3][1]);
  result[2][3] = -1.0;
  return result;
}

glm::dmat4 standInView(const glm::mat4& view, const glm::mat4& projection) {
  return glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -standOff(projection))) * glm::dmat4(view);
}

}  // namespace walr
