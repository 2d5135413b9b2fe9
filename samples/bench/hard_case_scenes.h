#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// One frame that strains the arithmetic of a regression on the normal, with the answer.
struct HardCase {
  std::string name;
  PackedFrame packed;  ///< In the project's own layout; history starts with it.
  /// 3 components: noise-free radiance, linear in the normal, so that an exact regression has no bias.
  Image truth;
  std::vector<std::uint8_t> counted;  ///< Pixels whose error counts: those with something to denoise.
};

/// Size of all hard cases.
inline constexpr fg::Extent kHardCaseExtent{64, 64};

/// Small but nonzero variance of the features, collinear features, isolated pixels, fireflies, values that are not
/// finite, extremes of radiance and depth, a grazing plane, normals on the octahedral fold and off the unit sphere.
/// Noise is exponential: a sample's deviation is its mean. The hard cases of tests/passes are others on purpose: they
/// are compared with a reference in double precision, need no known answer, and have smooth surfaces over two frames.
std::vector<HardCase> hardCases();

}  // namespace walr
