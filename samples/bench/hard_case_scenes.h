#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// One frame on which a regression with the normal as features is numerically hard, with the known truth.
struct HardCase {
  std::string name;
  PackedFrame packed;  ///< In the project's own layout, and without history.
  /// 3 components: noise-free radiance. It is linear in the normal, so that an exact regression has no bias.
  Image truth;
  std::vector<std::uint8_t> counted;  ///< Nonzero for pixels whose error counts: those with something to denoise.
};

/// Size of all hard cases.
inline constexpr fg::Extent kHardCaseExtent{66, 66};

/// All hard cases: small but nonzero variance of the features, collinear features, isolated pixels, fireflies,
/// non-finite values, extremes of radiance and depth, a grazing plane, normals on the octahedral fold and off the unit
/// sphere. Noise is exponential: the standard deviation of a sample is its mean. The hard cases of tests/passes differ
/// on purpose: they are compared with a reference in double precision, so that they need no known truth, and show
/// smooth surfaces in two frames.
std::vector<HardCase> hardCases();

}  // namespace walr
