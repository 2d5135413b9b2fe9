#include "tests/passes/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <sstream>

#include <gtest/gtest.h>

namespace walr::test {
namespace {

using namespace reference;

constexpr int kLuma2 = 14;

/// Errors of the averages of products that raw storage holds: the errors of the covariances, those of the means times
/// the other mean, and three roundings of the added product.
MomentValues rawError(const MergedMoments& merged) {
  const MomentValues& e = merged.error;
  const glm::dvec2 x = glm::abs(merged.moments.x);
  const glm::dvec3 y = glm::abs(merged.moments.y);
  const glm::dvec2 ex(e[0], e[1]);
  const glm::dvec3 ey(e[2], e[3], e[4]);
  const MomentValues ofMeans = toArray({.xx = {2.0 * x.x * ex.x, x.x * ex.y + x.y * ex.x, 2.0 * x.y * ex.y},
                                        .yu = y * ex.x + ey * x.x,
                                        .yv = y * ex.y + ey * x.y});
  const MomentValues raw = toArray(toRaw(merged.moments));
  MomentValues result{};
  for (int k = 0; k < kMomentCount; ++k) result[k] = e[k] + ofMeans[k] + 3.0 * kFloatRoundoff * std::abs(raw[k]);
  return result;
}

/// Whether R11G11B10 packing stores a value in the shorter third channel.
bool isBlue(int k) {
  return k == 4 || k == 7 || k == 10 || k == 13;
}

/// Largest relative rounding error of a stored value.
double roundoffOf(MomentStorage storage, int k) {
  switch (storage) {
    case MomentStorage::Centred16:
    case MomentStorage::Raw16:
      return 2.0 * kHalfRoundoff;  // Rounded either way.
    case MomentStorage::Raw11:
      return isBlue(k) ? kFloat10Roundoff : kFloat11Roundoff;  // The shader rounds to nearest itself.
    case MomentStorage::Raw32:
      return kFloatRoundoff;
  }
  return 0.0;
}

/// The largest value of a storage format, at which stored values saturate.
double largestOf(MomentStorage storage, int k) {
  switch (storage) {
    case MomentStorage::Centred16:
    case MomentStorage::Raw16:
      return kLargestHalf;
    case MomentStorage::Raw11:
      return roundToUnsignedFloat(1e30, isBlue(k) ? 5 : 6);
    case MomentStorage::Raw32:
      return std::numeric_limits<float>::max();
  }
  return 0.0;
}

/// Largest absolute rounding error near 0.
double smallestStepOf(MomentStorage storage) {
  if (storage == MomentStorage::Raw32) return 0x1p-126;  // Subnormal floats may be flushed to 0.
  return storage == MomentStorage::Raw11 ? 0x1p-20 : kSmallestHalf;
}

}  // namespace

double halfTolerance(double expected, double error) {
  return error + 2.0 * kHalfRoundoff * (std::abs(expected) + error) + kSmallestHalf;
}

glm::dvec3 halfTolerance(glm::dvec3 expected, glm::dvec3 error) {
  return {halfTolerance(expected.r, error.r), halfTolerance(expected.g, error.g), halfTolerance(expected.b, error.b)};
}

MomentValues storedValues(const Moments& centred, MomentStorage storage) {
  MomentValues values = toArray(storage == MomentStorage::Centred16 ? centred : toRaw(centred));
  values[kLuma2] = std::sqrt(values[kLuma2]);
  return values;
}

StoredMoments storedMoments(const MergedMoments& merged, MomentStorage storage) {
  StoredMoments stored;
  stored.expected = storedValues(merged.moments, storage);
  MomentValues error = storage == MomentStorage::Centred16 ? merged.error : rawError(merged);
  const double root = stored.expected[kLuma2];
  error[kLuma2] = root > 0.0 ? error[kLuma2] / (2.0 * root) + 4.0 * kFloatRoundoff * root : 0.0;
  for (int k = 0; k < kMomentCount; ++k) {
    stored.tolerance[k] =
        error[k] + roundoffOf(storage, k) * (std::abs(stored.expected[k]) + error[k]) + smallestStepOf(storage);
    stored.expected[k] = std::min(stored.expected[k], largestOf(storage, k));
  }
  return stored;
}

double surfaceRmse(const reference::Image<reference::Guide>& guides, const reference::Image<glm::dvec4>& actual,
                   const reference::Image<glm::dvec3>& expected) {
  const auto toneMapped = [](double x) { return x / (1.0 + x); };
  double squares = 0.0;
  int count = 0;
  reference::forEachPixel(guides.size(), [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    for (int c = 0; c < 3; ++c, ++count)
      squares += std::pow(toneMapped(actual[p][c]) - toneMapped(expected[p][c]), 2.0);
  });
  return count > 0 ? std::sqrt(squares / count) : 0.0;
}

void Comparison::value(glm::ivec2 p, const char* name, double actual, double expected, double tolerance) {
  const double difference = std::abs(actual - expected);
  if (difference <= tolerance) return;
  ++failures_;
  const double ratio = difference / tolerance;
  if (ratio <= worstRatio_) return;  // False for a NaN, which is therefore reported.
  worstRatio_ = ratio;
  std::ostringstream text;
  text.precision(9);
  text << name << " at (" << p.x << ", " << p.y << ") is " << actual << ", not " << expected << " within " << tolerance;
  worst_ = text.str();
}

void Comparison::colour(glm::ivec2 p, glm::dvec3 actual, glm::dvec3 expected, glm::dvec3 tolerance) {
  value(p, "red", actual.r, expected.r, tolerance.r);
  value(p, "green", actual.g, expected.g, tolerance.g);
  value(p, "blue", actual.b, expected.b, tolerance.b);
}

void Comparison::expect(double undecidedShare) const {
  EXPECT_EQ(failures_, 0) << what_ << ": " << worst_;
  EXPECT_GT(compared_, 0) << what_;
  EXPECT_LE(undecided_, undecidedShare * (undecided_ + compared_)) << what_;
}

}  // namespace walr::test
