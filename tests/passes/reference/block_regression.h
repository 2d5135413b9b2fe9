#pragma once

#include "passes/block_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// The regression over blocks by brute force. Averages of averages are averages of samples: every block's window is
/// kept as the weight of each pixel in it, and each fit is weighted least squares over those pixels. No moment is
/// merged, stored or rescaled.
/// @param accumulated rgb: radiance; alpha: number of samples behind it
Image<glm::dvec3> blockRegression(const HostFrame& frame, const Image<Guide>& guides,
                                  const Image<glm::dvec4>& accumulated, const BlockRegressionSettings& settings);

}  // namespace walr::reference
