#include "tests/passes/reference/regression.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace walr::reference {
namespace {

/// Solution of the normal equations.
struct Fit {
  std::vector<double> beta;  ///< Coefficients of the constant and the two features.
  MatrixRows factor;         ///< Cholesky factor of the normal equations.
  double lambda = 0.0;       ///< Ridge.
};

/// First-order bound of the error of the fitted colour, from errors of the moments and from single precision in the
/// solve. With slope b = A^-1 c: |delta b| <= |A^-1| (|delta c| + |delta A| |b|). For A = L L^t with L = (p 0; q r) the
/// trace 1 / p^2 + (1 + (q / p)^2) / r^2 of A^-1 bounds its norm.
double fitError(const Moments& m, glm::dvec2 offset, const MomentValues& e, const Fit& fit, double noiseRidge,
                int channel) {
  constexpr double kRoundings = 8.0 * kFloatRoundoff;
  const double mean = luminance(m.y);
  double lambdaError = kRoundings * fit.lambda;
  if (mean > 0.0) {
    const double relativeMeanError = luminance({e[2], e[3], e[4]}) / mean + kRoundings;
    const double relativeSecondMoment = m.luma2 / (mean * mean);
    lambdaError +=
        noiseRidge / m.samples *
        (e[14] / (mean * mean) + relativeSecondMoment * (2.0 * relativeMeanError + e[15] / m.samples + kRoundings));
  }
  const double p = fit.factor[1][1];
  const double q = fit.factor[2][1];
  const double r = fit.factor[2][2];
  const double inverseNorm = 1.0 / (p * p) + (1.0 + (q / p) * (q / p)) / (r * r);
  const double matrixError =
      e[5] + 2.0 * e[6] + e[7] + 2.0 * lambdaError + kRoundings * (std::abs(m.xx.x) + std::abs(m.xx.z));
  const glm::dvec2 slope(fit.beta[1], fit.beta[2]);
  const double slopeSize = std::abs(slope.x) + std::abs(slope.y);
  const double rightSize = std::abs(m.yu[channel]) + std::abs(m.yv[channel]);
  const double rightError = e[8 + channel] + e[11 + channel] + kRoundings * rightSize;
  const double slopeError = inverseNorm * (rightError + matrixError * slopeSize);
  return e[2 + channel] + slopeSize * (e[0] + e[1] + 2.0 * kFloatRoundoff) +
         (std::abs(offset.x) + std::abs(offset.y)) * slopeError +
         kRoundings * (std::abs(m.y[channel]) + std::abs(slope.x * offset.x) + std::abs(slope.y * offset.y));
}

}  // namespace

MatrixRows cholesky(const MatrixRows& a, const std::vector<double>& pivotFloors) {
  const std::size_t m = a.size();
  MatrixRows c(m, std::vector<double>(m, 0.0));
  for (std::size_t i = 0; i < m; ++i) {
    double pivot = a[i][i];
    for (std::size_t j = 0; j < i; ++j) pivot -= c[i][j] * c[i][j];
    c[i][i] = std::sqrt(std::max(pivot, pivotFloors[i]));
    for (std::size_t j = i + 1; j < m; ++j) {
      double value = a[i][j];
      for (std::size_t k = 0; k < i; ++k) value -= c[i][k] * c[j][k];
      c[j][i] = value / c[i][i];
    }
  }
  return c;
}

std::vector<double> solve(const MatrixRows& c, std::vector<double> y) {
  const std::size_t m = c.size();
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t j = 0; j < i; ++j) y[i] -= c[i][j] * y[j];
    y[i] /= c[i][i];
  }
  for (std::size_t j = m; j-- > 0;) {
    for (std::size_t i = j + 1; i < m; ++i) y[j] -= c[i][j] * y[i];
    y[j] /= c[j][j];
  }
  return y;
}

double relativeVariance(const Moments& m) {
  const double mean = luminance(m.y);
  return mean > 0.0 ? std::max(m.luma2 / (mean * mean) - 1.0, 0.0) : 0.0;
}

Reconstruction reconstruct(const Moments& m, glm::dvec2 features, const RegularisationSettings& settings,
                           const MomentValues& momentsError) {
  const bool ridged = settings.method == Regularisation::Ridge;
  const auto ridge = double(settings.ridge);
  const double noiseRidge = ridged ? double(settings.noiseRidge) : 0.0;
  Fit fit;
  fit.lambda = ridged ? ridge + (m.samples > 0.0 ? noiseRidge * relativeVariance(m) / m.samples : 0.0) : 0.0;
  const double pivotFloor = ridged ? fit.lambda : ridge;
  // The paper's normal equations with raw averages. The ridge does not apply to the constant, so that gain is 1.
  const Moments raw = toRaw(m);
  fit.factor = cholesky(
      {{1.0, m.x.x, m.x.y}, {m.x.x, raw.xx.x + fit.lambda, raw.xx.y}, {m.x.y, raw.xx.y, raw.xx.z + fit.lambda}},
      {0.0, pivotFloor, pivotFloor});
  Reconstruction result;
  for (int channel = 0; channel < 3; ++channel) {
    fit.beta = solve(fit.factor, {m.y[channel], raw.yu[channel], raw.yv[channel]});
    const double fitted = fit.beta[0] + fit.beta[1] * features.x + fit.beta[2] * features.y;
    result.colour[channel] = std::clamp(fitted, 0.0, kLargestHalf);
    result.error[channel] = fitError(m, features - m.x, momentsError, fit, noiseRidge, channel);
  }
  return result;
}

}  // namespace walr::reference
