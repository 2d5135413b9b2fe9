#pragma once

#include "passes/joint_bilateral_filter.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A filtered colour.
struct BilateralPixel {
  glm::dvec3 colour{0.0};
  /// Mean distance of the weighted pixels from their mean: what an error of the weights is multiplied by.
  glm::dvec3 spread{0.0};
};

/// Joint bilateral filter (Wang 2024, 2) of one noisy frame.
Image<BilateralPixel> jointBilateral(const HostFrame& frame, const Image<Guide>& guides,
                                     const JointBilateralFilterSettings& settings = {});

}  // namespace walr::reference
