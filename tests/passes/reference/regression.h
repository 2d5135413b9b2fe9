#pragma once

#include <vector>

#include "passes/regression/regularisation.h"
#include "tests/passes/reference/moments.h"

namespace walr::reference {

/// Square matrix of a regression with m features, row by row.
using MatrixRows = std::vector<std::vector<double>>;

/// Lower triangular C with C C^t = `a` for a symmetric matrix, each pivot no smaller than its floor (Meunier & Harada
/// 2022, algorithm 1).
MatrixRows cholesky(const MatrixRows& a, const std::vector<double>& pivotFloors);
/// Solve C C^t x = y (Meunier & Harada 2022, algorithm 2).
std::vector<double> solve(const MatrixRows& c, std::vector<double> y);

/// A reconstructed colour, with the error that single-precision arithmetic may have made in it.
struct Reconstruction {
  glm::dvec3 colour{0.0};
  glm::dvec3 error{0.0};
};

/// Relative variance of one input sample over the window: E[l^2] / E[l]^2 - 1.
double relativeVariance(const Moments& m);

/// Solve the normal equations (Meunier & Harada 2022, 3.1) for the constant and the two features, and evaluate the fit
/// at `features`. The result is at least 0 and at most the largest half. Regularisation::Ridge adds `ridge + noiseRidge
/// * relativeVariance / W` to the covariance's diagonal and floors the pivots there; Regularisation::Floor floors the
/// pivots at `ridge` (algorithm 1).
/// @param momentsError error bound of each moment; zeros where they are exact
Reconstruction reconstruct(const Moments& m, glm::dvec2 features, const RegularisationSettings& settings,
                           const MomentValues& momentsError = {});

}  // namespace walr::reference
