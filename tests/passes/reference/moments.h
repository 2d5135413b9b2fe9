#pragma once

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "passes/regression/weighted_regression.h"
#include "tests/passes/reference/storage.h"

namespace walr::reference {

/// The weighted averages of one pixel's regression (Meunier & Harada 2022, 3.1: XX and YX), in centred form: means, and
/// covariances about them.
struct Moments {
  glm::dvec2 x{0.0};     ///< Mean of the two features.
  glm::dvec3 y{0.0};     ///< Mean of the colour.
  glm::dvec3 xx{0.0};    ///< Covariances of the features: uu, uv, vv.
  glm::dvec3 yu{0.0};    ///< Covariance of the colour with the first feature.
  glm::dvec3 yv{0.0};    ///< Covariance of the colour with the second feature.
  double luma2 = 0.0;    ///< Mean of the squared luminance.
  double samples = 0.0;  ///< Sum of the sample weights, W.
};

/// Number of values in `Moments`.
inline constexpr int kMomentCount = 16;
using MomentValues = std::array<double, kMomentCount>;
/// Convert between `Moments` and an array of its values in the order of declaration.
MomentValues toArray(const Moments& m);
Moments fromArray(const MomentValues& values);
/// Names of the values, in the same order.
const char* momentName(int index);

/// Convert between covariances and the averages of products that raw storage holds: E[ab] = cov(a, b) + E[a] E[b].
Moments toRaw(const Moments& centred);
Moments toCentred(const Moments& raw);

/// Rec. 709 luminance, Y of passes/WALR.md.
double luminance(glm::dvec3 colour);

/// Moments of a single pixel: iteration 0 of the averages of Meunier & Harada 2022, 3.2.
/// @param accumulated rgb: mean; a: history length; at 0 the pixel has no sample
Moments momentsOf(glm::dvec2 features, glm::dvec4 accumulated);

/// Moments that take part in a merge.
struct WeightedMoments {
  Moments moments;
  double weight = 0.0;       ///< Edge weight; multiplies `moments.samples`.
  double weightError = 0.0;  ///< Bound of what single precision adds to the weight.
  MomentValues error{};      ///< Bound of what single precision added to the moments.
};

/// Merged moments, with the error that single-precision arithmetic may have made in each value.
struct MergedMoments {
  Moments moments;
  MomentValues error{};
};

/// Moments of the union of weighted sets of samples: the averages of averages of Meunier & Harada 2022, 3.2, in centred
/// form: C = sum w (C_i + (m_i - M)(m_i - M)^T) / sum w. If there is no sample, the means are those of the centre and
/// the rest is 0.
/// @param parts     the first is the window's centre, about which an implementation may take differences
/// @param additions the largest number of additions that a term goes through; nine by default, as in one iteration
MergedMoments merge(const WeightedMoments* parts, int count, int additions = 9);

/// Moments rounded to nearest as a storage format keeps them between two iterations (Meunier & Harada 2022, 5.2).
/// Centred storage keeps the root of the mean squared luminance; raw storage drops it and the sample count. If there is
/// no sample, all values are 0.
Moments roundMoments(const Moments& m, MomentStorage storage);

/// Bound of what single precision adds to moments when an iteration reads them: 0 for centred storage, else the
/// rounding of the subtraction that centres them.
MomentValues loadError(const Moments& m, MomentStorage storage);

/// Bound of what single precision adds to the moments of a single pixel, whose features are decoded from 16-bit unorms.
MomentValues sampleError(const Moments& m);

}  // namespace walr::reference
