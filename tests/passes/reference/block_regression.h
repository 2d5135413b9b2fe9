#pragma once

#include "passes/block_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// The regression over blocks by brute force. Averages of averages are averages of samples: every block's window is
/// kept as the weight of each pixel in it, and each fit is weighted least squares over those pixels. No moment is
/// merged, stored or rescaled.
/// @param accumulated rgb: radiance; alpha: number of samples behind it
/// @param occlusion   ambient occlusion
Image<glm::dvec3> blockRegression(const HostFrame& frame, const Image<Guide>& guides,
                                  const Image<glm::dvec4>& accumulated, const Image<double>& occlusion,
                                  const BlockRegressionSettings& settings);

/// Mean sine of the horizon above the tangent plane in eight directions, with occluders fading out at `radius` pixels
/// and looked for in so many steps.
Image<double> ambientOcclusion(const HostFrame& frame, const Image<Guide>& guides, double radius, int steps);

}  // namespace walr::reference
