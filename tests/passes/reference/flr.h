#pragma once

#include "passes/flr_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A filtered colour, with the error that single-precision arithmetic may have made in it.
struct FlrResult {
  glm::dvec3 colour{0.0};
  glm::dvec3 error{0.0};
};

/// Fast Local Regression without any of its shortcuts: every cell's least squares is summed over all pixels of its
/// window, in double precision and about the mean, and solved by the matrix's inverse.
Image<FlrResult> flrRegression(const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                               const FlrRegressionSettings& settings = {});

}  // namespace walr::reference
