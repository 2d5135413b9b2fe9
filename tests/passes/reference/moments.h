#pragma once

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "passes/weighted_regression.h"
#include "tests/passes/reference/storage.h"

namespace walr::reference {

/// The weighted averages behind one pixel's regression, centred: means, and covariances about them (Meunier & Harada
/// 2022, 3.1).
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
/// The values in the order of their declaration, and back.
MomentValues toArray(const Moments& m);
Moments fromArray(const MomentValues& values);
/// Names of the values in that order.
const char* momentName(int index);

/// The averages of products that raw storage holds in place of the covariances: E[ab] = cov(a, b) + E[a] E[b].
Moments toRaw(const Moments& centred);
Moments toCentred(const Moments& raw);

/// Rec. 709 luminance.
double luminance(glm::dvec3 colour);

/// Moments of a single pixel.
/// @param accumulated rgb: mean; a: number of samples behind it; 0: the pixel weighs nothing
Moments momentsOf(glm::dvec2 features, glm::dvec4 accumulated);

/// One part of a merge.
struct WeightedMoments {
  Moments moments;
  double weight = 0.0;       ///< Edge weight; multiplies `moments.samples`.
  double weightError = 0.0;  ///< Bound of what single precision adds to the weight.
  MomentValues error{};      ///< Bound of what single precision added to the moments.
};

/// A merge, with the error that single-precision arithmetic may have made in each value.
struct MergedMoments {
  Moments moments;
  MomentValues error{};
};

/// Moments of the union of weighted sets of samples: C = sum w (C_i + (m_i - M)(m_i - M)^T) / sum w. Without any sample
/// the means are the centre's, and the rest is 0.
/// @param parts     the first is the window's centre, about which an implementation may take differences
/// @param additions the most that a term goes through on its way into a sum; the nine of an iteration unless told
MergedMoments merge(const WeightedMoments* parts, int count, int additions = 9);

/// As a format keeps them between two iterations, rounded to nearest. Sixteen halves keep the mean squared luminance as
/// its root; raw formats drop it and the sample count. Without a sample all values are 0.
Moments roundMoments(const Moments& m, MomentStorage storage);

/// What single precision adds to moments that an iteration reads: nothing where they are stored centred, else the
/// rounding of the subtraction that centres them.
MomentValues loadError(const Moments& m, MomentStorage storage);

/// What single precision adds to the moments of a single sample: features are decoded from 16-bit unorms.
MomentValues sampleError(const Moments& m);

}  // namespace walr::reference
