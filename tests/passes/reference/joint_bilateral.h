#pragma once

#include "passes/filters/joint_bilateral_filter.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A filtered colour.
struct BilateralPixel {
  glm::dvec3 colour{0.0};
  /// Mean distance of the weighted pixels from their mean: the factor by which an error of the weights changes the
  /// colour.
  glm::dvec3 spread{0.0};
};

/// Joint bilateral filter of one noisy frame, with the kernel J of Wang 2024, 2.
Image<BilateralPixel> jointBilateral(const HostFrame& frame, const Image<Guide>& guides,
                                     const JointBilateralFilterSettings& settings = {});

}  // namespace walr::reference
