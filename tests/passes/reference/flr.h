#pragma once

#include "passes/regression/flr_regression.h"
#include "tests/passes/reference/guide_network.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A filtered colour, with the error that single-precision arithmetic may have made in it.
struct FlrResult {
  glm::dvec3 colour{0.0};
  glm::dvec3 error{0.0};
};

/// Fast Local Regression (Salmi et al. 2024: the weighted least-squares solution A*) without its shortcuts: the sums of
/// each cell go over all pixels of its window, in double precision and about the mean, and the matrix is inverted.
/// @param learned three guides beside the geometric ones, or five in their place; null: there are none
Image<FlrResult> flrRegression(const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                               const FlrRegressionSettings& settings = {}, const ChannelImage* learned = nullptr);

}  // namespace walr::reference
