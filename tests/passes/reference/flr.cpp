#include "tests/passes/reference/flr.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "tests/passes/reference/linear_system.h"
#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// Guides: normal, inverse depth, ambient occlusion, three of a network; or five of a network.
constexpr std::size_t kGuides = 8;
constexpr std::size_t kInverseDepth = 3;
using GuideVector = Vector<kGuides>;

/// A pixel of a window: weight, guides x and colour y.
struct Sample {
  double weight;
  GuideVector x;
  glm::dvec3 y;
};

/// The fit of one cell: colour = mean + slope (x - meanX).
struct Fit {
  bool found = false;
  GuideVector meanX{};
  glm::dvec3 meanY{0.0};
  std::array<GuideVector, 3> slope{};
  // Bounds of rounding in the sums of products: magnitudes of the inverse matrix, and the largest errors of the matrix
  // and of each right-hand side.
  Matrix<kGuides> inverseMagnitude{};
  Matrix<kGuides> matrixError{};
  std::array<GuideVector, 3> rightError{};
};

/// Inputs of the regression.
struct Inputs {
  const Image<Guide>& guides;
  const Image<glm::dvec3>& lighting;
  const FlrRegressionSettings& settings;
  const ChannelImage* learned;

  [[nodiscard]] bool learnedAlone() const { return learned != nullptr && learned->count == 5; }

  /// Guides of a pixel. One that is 0 everywhere gets a slope of 0.
  [[nodiscard]] GuideVector guidesAt(glm::ivec2 p) const {
    const auto more = [&](std::size_t i) { return learned != nullptr ? learned->at(i, p) : 0.0; };
    if (learnedAlone()) return {more(0), more(1), more(2), more(3), more(4), 0.0, 0.0, 0.0};
    const glm::dvec3 n = octahedralDecode(guides[p].features);
    const double occlusion = settings.occlusionGuide ? guides[p].occlusion : 0.0;
    return {n.x, n.y, n.z, 1.0 / guides[p].depth, occlusion, more(0), more(1), more(2)};
  }
};

/// The samples in the window of a cell, with Gaussian weights by the distance between cells (Salmi et al. 2024:
/// downsampled outer products, Gaussian blur).
std::vector<Sample> windowOf(const Inputs& in, glm::ivec2 cell) {
  const FlrRegressionSettings& settings = in.settings;
  const int factor = int(settings.factor);
  const double sigma = double(settings.sigma) / factor;
  const int radius = int(std::ceil(double(settings.reach) * sigma));
  std::vector<Sample> samples;
  forEachPixel(in.guides.size(), [&](glm::ivec2 p) {
    const glm::ivec2 d = p / factor - cell;
    if (std::max(std::abs(d.x), std::abs(d.y)) > radius) return;
    if (in.guides[p].depth == 0.0 || !isFinite(in.lighting[p])) return;
    const double weight = std::exp(-0.5 * (d.x * d.x + d.y * d.y) / (sigma * sigma));
    samples.push_back({weight, in.guidesAt(p), glm::clamp(in.lighting[p], 0.0, kLargestHalf)});
  });
  return samples;
}

/// Solve the normal equations of a window, (X^T X)^-1 X^T Y (Salmi et al. 2024), with a ridge.
/// @param geometric whether the guides are the geometric ones, of which inverse depth has a relative ridge
Fit fitCell(const std::vector<Sample>& samples, const FlrRegressionSettings& settings, bool geometric) {
  Fit fit;
  double total = 0.0;
  for (const Sample& s : samples) {
    total += s.weight;
    for (std::size_t i = 0; i < kGuides; ++i) fit.meanX[i] += s.weight * s.x[i];
    fit.meanY += s.weight * s.y;
  }
  if (total == 0.0) return fit;
  fit.found = true;
  for (double& x : fit.meanX) x /= total;
  fit.meanY /= total;

  Matrix<kGuides> covariance{};
  std::array<GuideVector, 3> right{};
  for (const Sample& s : samples) {
    const double w = s.weight / total;
    for (std::size_t i = 0; i < kGuides; ++i) {
      const double dx = s.x[i] - fit.meanX[i];
      for (std::size_t j = 0; j < kGuides; ++j) {
        covariance[i][j] += w * dx * (s.x[j] - fit.meanX[j]);
        fit.matrixError[i][j] += w * std::abs(s.x[i] * s.x[j]);
      }
      for (int c = 0; c < 3; ++c) {
        right[c][i] += w * (s.y[c] - fit.meanY[c]) * dx;
        fit.rightError[c][i] += w * s.y[c] * std::abs(s.x[i]);
      }
    }
  }
  const double meanDepth = fit.meanX[kInverseDepth];
  for (std::size_t i = 0; i < kGuides; ++i)
    covariance[i][i] += double(settings.ridge) * (geometric && i == kInverseDepth ? meanDepth * meanDepth : 1.0);
  const Matrix<kGuides> inverted = inverse(covariance);
  for (int c = 0; c < 3; ++c) fit.slope[c] = inverted * right[c];
  for (std::size_t i = 0; i < kGuides; ++i) fit.inverseMagnitude[i] = absolute(inverted[i]);

  // A sum of products goes through one addition per pixel of a cell and per tap of each blur, each of which rounds the
  // partial sum. The exponential of a weight errs by a few roundoffs more (Vulkan: 3 + 2 |x| units). Then comes the
  // difference of E[ab] and E[a] E[b], which both err alike.
  const double reach = 2.0 * std::ceil(double(settings.reach) * double(settings.sigma) / settings.factor) + 1.0;
  const double exponent = 0.5 * double(settings.reach) * double(settings.reach) + 1.0;
  const double roundings = double(settings.factor * settings.factor) + 2.0 * (reach + 6.0 + 4.0 * exponent) + 8.0;
  const double relative = 2.0 * roundings * kFloatRoundoff;
  for (GuideVector& row : fit.matrixError)
    for (double& entry : row) entry *= relative;
  for (GuideVector& column : fit.rightError)
    for (double& entry : column) entry *= relative;
  return fit;
}

/// Evaluate a fit at a pixel's guides, I_k = x_k A_k* (Salmi et al. 2024), with a bound of the error.
FlrResult predict(const Fit& fit, const GuideVector& x) {
  FlrResult result;
  GuideVector d = x;
  GuideVector size = absolute(x);
  for (std::size_t i = 0; i < kGuides; ++i) {
    d[i] -= fit.meanX[i];
    size[i] += std::abs(fit.meanX[i]);
  }
  for (int c = 0; c < 3; ++c) {
    const GuideVector slope = absolute(fit.slope[c]);
    GuideVector rightError = fit.matrixError * slope;
    for (std::size_t i = 0; i < kGuides; ++i) rightError[i] += fit.rightError[c][i];
    // The shader's constant is the mean minus the slope times the mean guides, which evaluation adds again.
    result.colour[c] = fit.meanY[c] + dot(fit.slope[c], d);
    result.error[c] =
        dot(fit.inverseMagnitude * rightError, absolute(d)) + 16.0 * kFloatRoundoff * (fit.meanY[c] + dot(slope, size));
  }
  return result;
}

/// Upsampling weight of a cell at a distance of `t` cells along one axis.
double cellWeight(double t, FlrUpsampling upsampling) {
  const double d = std::abs(t);
  if (upsampling == FlrUpsampling::Nearest) return d < 0.5 ? 1.0 : 0.0;
  if (upsampling == FlrUpsampling::Bilinear) return std::max(1.0 - d, 0.0);
  // The cubic B-spline is the fourfold convolution of a box, here as a sum of truncated powers.
  const auto cube = [](double x) { return x > 0.0 ? x * x * x : 0.0; };
  return (cube(2.0 - d) - 4.0 * cube(1.0 - d)) / 6.0;
}

}  // namespace

Image<FlrResult> flrRegression(const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                               const FlrRegressionSettings& settings, const ChannelImage* learned) {
  const Inputs in{guides, lighting, settings, learned};
  const int factor = int(settings.factor);
  Image<Fit> fits((guides.size() + factor - 1) / factor);
  forEachPixel(fits.size(),
               [&](glm::ivec2 cell) { fits[cell] = fitCell(windowOf(in, cell), settings, !in.learnedAlone()); });

  Image<FlrResult> results(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    FlrResult& result = results[p];
    if (guides[p].depth == 0.0) {
      result.colour = isFinite(lighting[p]) ? lighting[p] : glm::dvec3(0.0);
      return;
    }
    const GuideVector x = in.guidesAt(p);
    const glm::dvec2 position = (glm::dvec2(p) + 0.5) / double(factor) - 0.5;
    double weightSum = 0.0;
    for (int i = 0; i < 25; ++i) {
      const glm::ivec2 cell = glm::ivec2(glm::floor(position)) + glm::ivec2(i % 5, i / 5) - 2;
      const double weight =
          cellWeight(position.x - cell.x, settings.upsampling) * cellWeight(position.y - cell.y, settings.upsampling);
      if (weight == 0.0 || !fits.contains(cell) || !fits[cell].found) continue;
      const FlrResult prediction = predict(fits[cell], x);
      weightSum += weight;
      result.colour += weight * prediction.colour;
      result.error += weight * prediction.error;
    }
    if (weightSum > 0.0) {
      result.colour = glm::clamp(result.colour / weightSum, 0.0, kLargestHalf);
      result.error /= weightSum;
    }
  });
  return results;
}

}  // namespace walr::reference
