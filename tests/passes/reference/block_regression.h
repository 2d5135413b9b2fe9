#pragma once

#include "passes/regression/block_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// The regression over blocks of passes/WALR.md, 4 to 8, by brute force. An average of averages is an average of
/// samples, so every window is kept as the weight of each pixel in it, and each fit is weighted least squares over
/// those pixels. No moments are merged, stored or rescaled.
/// @param accumulated rgb: radiance; a: history length
/// @param onLightGrid whether only pixels with a sample of sparse light count in fits, as light and as surfaces
Image<glm::dvec3> blockRegression(const HostFrame& frame, const Image<Guide>& guides,
                                  const Image<glm::dvec4>& accumulated, const BlockRegressionSettings& settings,
                                  bool onLightGrid = false);

}  // namespace walr::reference
