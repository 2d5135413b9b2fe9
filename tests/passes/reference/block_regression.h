#pragma once

#include "passes/regression/block_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// What tells of the lobe of specular light at a pixel.
struct Reflector {
  double roughness = 0.0;
  double inverseDistance = 0.0;  ///< The surface's depth over the distance of what it reflects; 0: infinitely far.
};

/// Least share of accumulated light where a lobe shows an image (passes/SPECULAR.md).
/// @param pixel the angle of one
double imageShare(double roughness, double pixel);

/// The regression over blocks of passes/WALR.md, 4 to 8, by brute force. An average of averages is an average of
/// samples, so every window is kept as the weight of each pixel in it, and each fit is weighted least squares over
/// those pixels. No moments are merged, stored or rescaled.
/// @param accumulated rgb: radiance; a: history length
/// @param reflectors  given for specular light; the least share of accumulated light is then added
/// @param onLightGrid whether only pixels with a sample of sparse light count in fits, as light and as surfaces
Image<glm::dvec3> blockRegression(const HostFrame& frame, const Image<Guide>& guides,
                                  const Image<glm::dvec4>& accumulated, const BlockRegressionSettings& settings,
                                  bool onLightGrid = false, const Image<Reflector>* reflectors = nullptr);

}  // namespace walr::reference
