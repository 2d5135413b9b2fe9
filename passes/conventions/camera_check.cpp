#include "passes/conventions/camera_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace walr {
namespace {

/// Products of a few single-precision matrices are off by some 1e-6. An error of this size in a view matrix moves a
/// reprojected surface by a tenth of a pixel in an image of 1000.
constexpr double kTolerance = 1e-4;

bool isNear(double value, double expected) {
  return std::abs(value - expected) <= kTolerance;
}

bool isFinite(const glm::dmat4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(m[column][row])) return false;
    }
  }
  return true;
}

[[noreturn]] void refuse(const char* matrix, const std::string& cause) {
  throw std::invalid_argument("the " + std::string(matrix) + " matrix " + cause);
}

bool isAffine(const glm::dmat4& m) {
  return isNear(m[0][3], 0.0) && isNear(m[1][3], 0.0) && isNear(m[2][3], 0.0) && isNear(m[3][3], 1.0);
}

constexpr const char* kEye =
    "moves the image by a share of inverse depth, as the eyes of a stereo camera do; put that offset into the view "
    "matrix";
constexpr const char* kOblique =
    "moves the image by a share of depth, as oblique projections do; point the camera along its rays instead";

/// Refuse a projection whose axes are not those of the image.
/// @param shift   how the image moves with depth; must be 0
/// @param shifted what to say if it is not
template <typename Reject>
void checkAxes(const glm::dmat4& p, glm::dvec2 shift, const char* shifted, const Reject& reject) {
  if (!isNear(p[1][0], 0.0) || !isNear(p[0][1], 0.0)) {
    reject("rotates or shears the image; pass it without the rotation of the display");
  }
  if (!isNear(shift.x, 0.0) || !isNear(shift.y, 0.0)) reject(shifted);
  if (p[0][0] == 0.0 || p[1][1] == 0.0) reject("is singular: a focal length is 0");
  if (p[0][0] < 0.0) reject("mirrors x: its element in column 0, row 0 is negative; pass the unmirrored matrix");
  if (p[1][1] < 0.0) {
    reject(
        "has y down, as is usual for Vulkan (its element in column 1, row 1 is negative); clip space has y up here: "
        "negate row y of the matrix that is passed (the images stay as they are)");
  }
}

}  // namespace

void checkProjection(const glm::mat4& projection, bool orthographic) {
  const auto reject = [](const std::string& cause) { refuse("projection", cause); };
  const glm::dmat4 p(projection);
  if (!isFinite(p)) reject("is not finite");
  const bool lastRowIsOrthographic = isNear(p[0][3], 0.0) && isNear(p[1][3], 0.0) && p[2][3] == 0.0 && p[3][3] == 1.0;
  if (orthographic && !lastRowIsOrthographic) {
    reject(
        "does not give clip.w = 1, so it is not that of an orthographic camera, which is what the conventions state; "
        "use another denoiser for frames with a perspective camera");
  }
  if (orthographic) return checkAxes(p, glm::dvec2(p[2][0], p[2][1]), kOblique, reject);
  if (isNear(p[2][3], 0.0) && isNear(p[3][3], 1.0)) {
    reject(
        "is orthographic; state it when the denoiser is created: WalrConventions::orthographic, or in C++ "
        "HostConventions::orthographic and FrameDescription::orthographic");
  }
  const bool lastRowIsPerspective =
      isNear(p[0][3], 0.0) && isNear(p[1][3], 0.0) && isNear(p[3][3], 0.0) && isNear(std::abs(p[2][3]), 1.0);
  if (!lastRowIsPerspective && isNear(p[3][3], 0.0) && isNear(std::abs(p[3][2]), 1.0)) {
    reject("is transposed; matrices are column-major and multiply column vectors");
  }
  if (!lastRowIsPerspective) {
    reject(
        "does not give clip.w = -view.z, so it is not that of a perspective camera; the likely causes are the inverse "
        "matrix, a product with the view matrix, or a scaled matrix; pass the camera's view-to-clip matrix");
  }
  if (p[2][3] > 0.0) {
    reject(
        "is left-handed (clip.w = view.z); view space is right-handed with the camera looking down -z: negate row z "
        "of the view matrix and column z of the projection");
  }
  checkAxes(p, glm::dvec2(p[3][0], p[3][1]), kEye, reject);
}

bool sameView(const glm::mat4& a, const glm::mat4& b) {
  constexpr float kRoundings = 16.0F;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      const float x = a[column][row];
      const float y = b[column][row];
      const float scale = std::max({1.0F, std::abs(x), std::abs(y)});
      if (std::abs(x - y) > kRoundings * std::numeric_limits<float>::epsilon() * scale) return false;
    }
  }
  return true;
}

void checkOrigin(const glm::dvec3& origin) {
  // Doubles of this size are rounded by 2^-24, as floats of size 1.
  constexpr double kFarthest = 0x1p29;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(origin[axis]) <= kFarthest) continue;
    throw std::invalid_argument("the camera's origin is " + std::to_string(origin[axis]) +
                                " along an axis: it must be finite and at most 2^29 units from the world's, which is " +
                                "as far as double precision suffices; take an origin nearer to the camera");
  }
}

void checkView(const glm::mat4& view) {
  const auto reject = [](const std::string& cause) { refuse("view", cause); };
  const glm::dmat4 v(view);
  if (!isFinite(v)) reject("is not finite");
  if (std::abs(glm::determinant(v)) < 1e-30) reject("is singular; pass the camera's world-to-view matrix");
  if (!isAffine(v)) {
    if (isAffine(glm::transpose(v))) {
      reject("is transposed; matrices are column-major and multiply column vectors");
    }
    reject("is not affine: its last row is not (0, 0, 0, 1); pass world to view without the projection");
  }
  const glm::dmat3 rotation(v);
  const glm::dvec3 lengths(glm::length(rotation[0]), glm::length(rotation[1]), glm::length(rotation[2]));
  const double cosine = std::max({std::abs(glm::dot(rotation[0], rotation[1])) / (lengths.x * lengths.y),
                                  std::abs(glm::dot(rotation[1], rotation[2])) / (lengths.y * lengths.z),
                                  std::abs(glm::dot(rotation[2], rotation[0])) / (lengths.z * lengths.x)});
  if (cosine > kTolerance) reject("is sheared: its axes are not perpendicular; pass a rotation and a translation");
  if (!isNear(lengths.x, 1.0) || !isNear(lengths.y, 1.0) || !isNear(lengths.z, 1.0)) {
    reject(
        "scales: view space must have the units of world space; pass a rotation and a translation, and take scale out "
        "of the camera's node");
  }
  if (glm::determinant(rotation) < 0.0) {
    reject(
        "mirrors, so view space is left-handed; it must be right-handed with x to the right, y up and the camera "
        "looking down -z: negate row z");
  }
}

}  // namespace walr
