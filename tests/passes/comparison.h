#pragma once

#include <string>

#include <glm/vec2.hpp>

#include "passes/weighted_regression.h"
#include "tests/passes/reference/moments.h"

/// Comparison of a device's results with the double-precision reference. A tolerance is the sum of two bounds: what
/// single-precision arithmetic may add (worked out by the reference along with each value) and what rounding to the
/// storage format adds. Nothing is tuned.
namespace walr::test {

/// Tolerance of a value that is stored as a half. A conversion may round either way (Vulkan leaves the rounding of
/// image stores and of packHalf2x16 to the driver), so that it errs by a unit in the last place: two roundoffs.
double halfTolerance(double expected, double error);

/// The moments as they are stored, and the tolerance of each.
struct StoredMoments {
  reference::MomentValues expected{};
  reference::MomentValues tolerance{};
};
StoredMoments storedMoments(const reference::MergedMoments& merged, MomentStorage storage);
/// The same values of moments read back from a device.
reference::MomentValues storedValues(const reference::Moments& centred, MomentStorage storage);

/// Collects a comparison of two pictures. Pixels where a decision is closer than single precision can tell are counted
/// instead of compared.
class Comparison {
 public:
  explicit Comparison(std::string what) : what_(std::move(what)) {}

  /// Count a pixel, whose result may hang on a decision within rounding.
  /// @returns whether it does, so that the pixel is not to be compared
  [[nodiscard]] bool skips(bool undecided) {
    ++(undecided ? undecided_ : compared_);
    return undecided;
  }
  /// Count a pixel whose result hangs on no decision.
  void compared() { ++compared_; }
  /// One value of a compared pixel.
  void value(glm::ivec2 p, const char* name, double actual, double expected, double tolerance);

  /// Report to GoogleTest: every value within its tolerance, and no more than this share of pixels undecided.
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
