#include "tests/passes/reference/flr.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

glm::dvec4 guideVector(const Guide& guide) {
  return {octahedralDecode(guide.features), 1.0 / guide.depth};
}

bool isFinite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct Sample {
  double weight;
  glm::dvec4 x;
  glm::dvec3 y;
};

/// The fit of one cell: colour = mean + slope (x - meanX).
struct Fit {
  bool found = false;
  glm::dvec4 meanX{0.0};
  glm::dvec3 meanY{0.0};
  std::array<glm::dvec4, 3> slope{};
  // What rounding the sums of products may change: the inverse of the matrix, and the largest error of its entries and
  // of each right-hand side.
  glm::dmat4 inverse{1.0};
  glm::dmat4 matrixError{0.0};
  std::array<glm::dvec4, 3> rightError{};
};

/// The samples of all cells in the window of a cell, each with its cell's Gaussian weight.
std::vector<Sample> windowOf(const Image<Guide>& guides, const Image<glm::dvec3>& lighting, glm::ivec2 cell,
                             const FlrRegressionSettings& settings) {
  const int factor = int(settings.factor);
  const double sigma = double(settings.sigma) / factor;
  const int radius = int(std::ceil(double(settings.reach) * sigma));
  std::vector<Sample> samples;
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    const glm::ivec2 d = p / factor - cell;
    if (std::max(std::abs(d.x), std::abs(d.y)) > radius) return;
    if (guides[p].depth == 0.0 || !isFinite(lighting[p])) return;
    const double weight = std::exp(-0.5 * (d.x * d.x + d.y * d.y) / (sigma * sigma));
    samples.push_back({weight, guideVector(guides[p]), glm::clamp(lighting[p], 0.0, kLargestHalf)});
  });
  return samples;
}

Fit fitCell(const std::vector<Sample>& samples, const FlrRegressionSettings& settings) {
  Fit fit;
  double total = 0.0;
  glm::dvec4 absoluteX{0.0};
  for (const Sample& s : samples) {
    total += s.weight;
    fit.meanX += s.weight * s.x;
    fit.meanY += s.weight * s.y;
    absoluteX += s.weight * glm::abs(s.x);
  }
  if (total == 0.0) return fit;
  fit.found = true;
  fit.meanX /= total;
  fit.meanY /= total;

  glm::dmat4 covariance{0.0};
  glm::dmat4 magnitude{0.0};
  std::array<glm::dvec4, 3> right{};
  std::array<glm::dvec4, 3> rightMagnitude{};
  for (const Sample& s : samples) {
    const double w = s.weight / total;
    const glm::dvec4 dx = s.x - fit.meanX;
    covariance += w * glm::outerProduct(dx, dx);
    magnitude += w * glm::outerProduct(glm::abs(s.x), glm::abs(s.x));
    for (int c = 0; c < 3; ++c) {
      right[c] += w * (s.y[c] - fit.meanY[c]) * dx;
      rightMagnitude[c] += w * s.y[c] * glm::abs(s.x);
    }
  }
  const double ridge = settings.ridge;
  const glm::dvec4 ridges(ridge, ridge, ridge, ridge * fit.meanX.w * fit.meanX.w);
  for (int i = 0; i < 4; ++i) covariance[i][i] += ridges[i];
  fit.inverse = glm::inverse(covariance);
  for (int c = 0; c < 3; ++c) fit.slope[c] = fit.inverse * right[c];

  // A sum of products goes through one addition per pixel of a cell and per tap of each blur, every one rounding what
  // is summed so far; the exponential of a weight errs by a few roundoffs more (Vulkan: 3 + 2 |x| units); then comes
  // the difference of E[ab] and E[a] E[b], of which both err alike.
  const double reach = 2.0 * std::ceil(double(settings.reach) * double(settings.sigma) / settings.factor) + 1.0;
  const double exponent = 0.5 * double(settings.reach) * double(settings.reach) + 1.0;
  const double roundings = double(settings.factor * settings.factor) + 2.0 * (reach + 6.0 + 4.0 * exponent) + 8.0;
  const double relative = 2.0 * roundings * kFloatRoundoff;
  fit.matrixError = relative * magnitude;
  for (int c = 0; c < 3; ++c) fit.rightError[c] = relative * rightMagnitude[c];
  return fit;
}

glm::dvec4 absolute(const glm::dmat4& m, glm::dvec4 v) {
  glm::dvec4 result(0.0);
  for (int i = 0; i < 4; ++i) result += glm::abs(m[i]) * v[i];
  return result;
}

}  // namespace

Image<FlrResult> flrRegression(const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                               const FlrRegressionSettings& settings) {
  const int factor = int(settings.factor);
  Image<Fit> fits((guides.size() + factor - 1) / factor);
  forEachPixel(fits.size(),
               [&](glm::ivec2 cell) { fits[cell] = fitCell(windowOf(guides, lighting, cell, settings), settings); });

  Image<FlrResult> results(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    FlrResult& result = results[p];
    if (guides[p].depth == 0.0) {
      result.colour = isFinite(lighting[p]) ? lighting[p] : glm::dvec3(0.0);
      return;
    }
    const glm::dvec4 x = guideVector(guides[p]);
    const glm::dvec2 position = (glm::dvec2(p) + 0.5) / double(factor) - 0.5;
    const glm::ivec2 base = glm::ivec2(glm::floor(position));
    const glm::dvec2 f = position - glm::dvec2(base);
    double weightSum = 0.0;
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 offset(i % 2, i / 2);
      const glm::ivec2 cell = base + offset;
      if (!fits.contains(cell) || !fits[cell].found) continue;
      const Fit& fit = fits[cell];
      const double weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
      weightSum += weight;
      const glm::dvec4 d = x - fit.meanX;
      for (int c = 0; c < 3; ++c) {
        const glm::dvec4 slopeError =
            absolute(fit.inverse, fit.rightError[c] + absolute(fit.matrixError, glm::abs(fit.slope[c])));
        // The constant is the mean minus the slope's part of it, which evaluation adds again.
        const double evaluation =
            16.0 * kFloatRoundoff * glm::dot(glm::abs(fit.slope[c]), glm::abs(x) + glm::abs(fit.meanX));
        result.colour[c] += weight * (fit.meanY[c] + glm::dot(fit.slope[c], d));
        result.error[c] += weight * (glm::dot(slopeError, glm::abs(d)) + evaluation);
      }
    }
    if (weightSum > 0.0) {
      result.colour = glm::clamp(result.colour / weightSum, 0.0, kLargestHalf);
      result.error /= weightSum;
    }
  });
  return results;
}

}  // namespace walr::reference
