#pragma once

#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "passes/regression/weighted_regression.h"
#include "tests/passes/reference/guides.h"
#include "tests/passes/reference/moments.h"

/// Comparison of a device's results with the double-precision reference. A tolerance is the sum of two bounds: the
/// error of single-precision arithmetic, which the reference computes along with each value, and the rounding of the
/// storage format. No tolerance is tuned.
namespace walr::test {

/// Tolerance of a value that is stored as a half. Vulkan leaves the rounding of image stores and of packHalf2x16 to the
/// driver. A conversion may therefore err by a unit in the last place, which is two roundoffs.
double halfTolerance(double expected, double error);
/// The same by channel.
glm::dvec3 halfTolerance(glm::dvec3 expected, glm::dvec3 error);

/// The moments as they are stored, and the tolerance of each.
struct StoredMoments {
  reference::MomentValues expected{};
  reference::MomentValues tolerance{};
};
StoredMoments storedMoments(const reference::MergedMoments& merged, MomentStorage storage);
/// The stored form of moments read back from a device.
reference::MomentValues storedValues(const reference::Moments& centred, MomentStorage storage);

/// Root mean square difference after the tone map x / (1 + x), over pixels that show a surface. 0 if none does.
double surfaceRmse(const reference::Image<reference::Guide>& guides, const reference::Image<glm::dvec4>& actual,
                   const reference::Image<glm::dvec3>& expected);

/// Comparison of two images. Undecided pixels, where a decision is closer than single precision can resolve, are
/// counted instead of compared.
class Comparison {
 public:
  explicit Comparison(std::string what) : what_(std::move(what)) {}

  /// Count a pixel as compared, or as undecided if its result depends on a decision within rounding.
  /// @returns whether it is undecided, so that the caller does not compare it
  [[nodiscard]] bool skips(bool undecided) {
    ++(undecided ? undecided_ : compared_);
    return undecided;
  }
  /// Count a pixel whose result depends on no such decision.
  void compared() { ++compared_; }
  /// Compare one value of a pixel.
  void value(glm::ivec2 p, const char* name, double actual, double expected, double tolerance);
  /// Compare a pixel's colour.
  void colour(glm::ivec2 p, glm::dvec3 actual, glm::dvec3 expected, glm::dvec3 tolerance);

  /// Report to GoogleTest: every value must lie within its tolerance, and no more than this share of pixels may be
  /// undecided.
  void expect(double undecidedShare) const;

 private:
  std::string what_;
  std::string worst_;
  double worstRatio_ = 0.0;
  int failures_ = 0;
  int undecided_ = 0;
  int compared_ = 0;
};

}  // namespace walr::test
