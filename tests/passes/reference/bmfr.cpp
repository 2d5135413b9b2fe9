#include "tests/passes/reference/bmfr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

constexpr int kBlockSize = 32;
constexpr int kFeatures = 10;
using Column = std::vector<double>;
using Features = std::array<double, kFeatures>;

/// Displacements of the block grid, one per frame in turn (Koskela et al. 2019, 3.5 and 6.1).
constexpr std::array<std::array<int, 2>, 16> kOffsets{{{-14, -14},
                                                       {4, -6},
                                                       {-8, 14},
                                                       {8, 0},
                                                       {-10, -8},
                                                       {2, 12},
                                                       {12, -12},
                                                       {-10, 0},
                                                       {12, 14},
                                                       {-8, -16},
                                                       {6, 6},
                                                       {-2, -2},
                                                       {6, -14},
                                                       {-16, 12},
                                                       {14, -4},
                                                       {-6, 4}}};

/// Reflect a coordinate at the borders of 0 .. size - 1 until it lies inside.
int mirrored(int x, int size) {
  while (x < 0 || x >= size) x = x < 0 ? -1 - x : 2 * size - 1 - x;
  return x;
}

/// A pixel of a block: world-space features and noisy colour.
struct Sample {
  glm::ivec2 place;  ///< Position before it is reflected at the image's border.
  bool counts = false;
  glm::dvec3 normal{0.0};
  glm::dvec3 position{0.0};
  glm::dvec3 colour{0.0};
};

/// The pixels of the block at `origin`, its window Omega (Koskela et al. 2019, 3.3).
std::vector<Sample> samplesOf(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                              glm::ivec2 origin) {
  const glm::dmat3 worldFromView = glm::transpose(glm::dmat3(frame.constants.viewFromWorld));
  std::vector<Sample> samples;
  forEachPixel(glm::ivec2(kBlockSize), [&](glm::ivec2 p) {
    Sample s{.place = origin + p};
    const glm::ivec2 q(mirrored(s.place.x, guides.size().x), mirrored(s.place.y, guides.size().y));
    const Guide& guide = guides[q];
    s.counts = guide.depth > 0.0 && isFinite(lighting[q]);
    if (guide.depth > 0.0) {
      s.normal = worldFromView * octahedralDecode(guide.features);
      s.position = worldFromView * (rayThrough(frame.constants.rayFromPixel, pixelCentre(q)) * guide.depth);
    }
    s.colour = glm::clamp(lighting[q], 0.0, kLargestHalf);
    samples.push_back(s);
  });
  return samples;
}

/// Maps world positions to [-1, 1] within a block.
struct Scaling {
  glm::dvec3 centre{0.0};
  glm::dvec3 scale{1.0};
};

/// Scaling of a block's features to [-1, 1] (Koskela et al. 2019, 3.4).
Scaling scalingOf(const std::vector<Sample>& samples, const Image<Guide>& guides, double extentFloor) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(-low);
  for (const Sample& s : samples) {
    const glm::ivec2 q(mirrored(s.place.x, guides.size().x), mirrored(s.place.y, guides.size().y));
    if (guides[q].depth == 0.0) continue;
    low = glm::min(low, s.position);
    high = glm::max(high, s.position);
  }
  const glm::dvec3 half = 0.5 * (high - low);
  const double least = std::max(extentFloor * std::max({half.x, half.y, half.z}), 1e-30);
  return {0.5 * (high + low), 1.0 / glm::max(half, glm::dvec3(least))};
}

/// The feature buffers T (Koskela et al. 2019, equation 8).
Features featuresOf(const Sample& s, const Scaling& scaling) {
  const glm::dvec3 w = (s.position - scaling.centre) * scaling.scale;
  const glm::dvec3 n = s.normal;
  return {1.0, n.x, n.y, n.z, w.x, w.y, w.z, w.x * w.x, w.y * w.y, w.z * w.z};
}

/// The noise N of stochastic regularisation (Koskela et al. 2019, equation 7), in [-1, 1].
Features noiseOf(int index, glm::ivec2 block, std::uint32_t frameIndex) {
  Features noise{};
  for (int i = 1; i < kFeatures; ++i) {
    const glm::uvec4 key(index, block.y << 16 | block.x, frameIndex, (i - 1) / 4);
    noise[i] = double(pcg4d(key)[(i - 1) % 4]) / 4294967295.0 * 2.0 - 1.0;
  }
  return noise;
}

double dot(const Column& a, const Column& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// QR solution of the least-squares problem (Koskela et al. 2019, equations 2 and 5) with the features that are not
/// linearly dependent on earlier ones: A = Q R, R c = Q^t y.
struct Fit {
  std::vector<int> used;    ///< Features in use.
  std::vector<Features> r;  ///< Row i of R, over positions in `used`.
  std::array<Features, 3> coefficients{};
  Features columnLength{};
  std::array<double, 3> residual{};
  bool undecided = false;
};

/// Solve R x = b, or R^t x = b, over the features in use.
Features solveTriangle(const Fit& fit, const Features& b, bool transposed) {
  const int rank = int(fit.used.size());
  Features x{};
  for (int step = 0; step < rank; ++step) {
    const int i = transposed ? step : rank - 1 - step;
    double value = b[i];
    for (int j = 0; j < rank; ++j) {
      if (transposed && j < i) value -= fit.r[j][i] * x[j];
      if (!transposed && j > i) value -= fit.r[i][j] * x[j];
    }
    x[i] = value / fit.r[i][i];
  }
  return x;
}

/// Factorise the features and solve equations 2 and 5 of Koskela et al. 2019 for each colour channel.
Fit solve(const std::vector<Column>& features, const std::array<Column, 3>& colours, double tolerance) {
  Fit fit;
  std::vector<Column> q;
  const double rows = double(features[0].size());
  for (int k = 0; k < kFeatures; ++k) {
    Column column = features[k];
    Features projections{};
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t i = 0; i < q.size(); ++i) {
        const double projection = dot(q[i], column);
        projections[i] += projection;
        for (std::size_t row = 0; row < column.size(); ++row) column[row] -= projection * q[i][row];
      }
    }
    const double length = std::sqrt(dot(column, column));
    const double limit = tolerance * std::sqrt(rows);
    // Householder's method makes ten reflections, each with sums that are forty additions deep.
    const double lengthError = 400.0 * kFloatRoundoff * std::sqrt(dot(features[k], features[k]));
    if (rows > 0.0 && std::abs(length - limit) <= lengthError && length > 0.0) fit.undecided = true;
    if (!(length > limit)) continue;
    for (double& value : column) value /= length;
    const std::size_t position = q.size();
    q.push_back(column);
    fit.used.push_back(k);
    fit.columnLength[position] = std::sqrt(dot(features[k], features[k]));
    for (std::size_t i = 0; i < position; ++i) fit.r[i][position] = projections[i];
    fit.r.push_back({});
    fit.r[position][position] = length;
  }
  for (int c = 0; c < 3; ++c) {
    Column rest = colours[c];
    Features right{};
    for (std::size_t i = 0; i < q.size(); ++i) {
      right[i] = dot(q[i], rest);
      for (std::size_t row = 0; row < rest.size(); ++row) rest[row] -= right[i] * q[i][row];
    }
    fit.coefficients[c] = solveTriangle(fit, right, false);
    fit.residual[c] = std::sqrt(dot(rest, rest));
  }
  return fit;
}

double length(const Features& v) {
  double sum = 0.0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// The fit at noise-free features (Koskela et al. 2019, equation 3), with a bound of its error in single precision. The
/// solution by Householder's method is that of a matrix whose columns are off by a relative `kColumnError` (Higham,
/// Accuracy and Stability of Numerical Algorithms, theorem 20.3). To first order a change E of the matrix A moves the
/// prediction f.c by (A^+)^t f . E c and by (A^t A)^-1 f . E^t r.
BmfrResult evaluate(const Fit& fit, const Features& features, double featureError) {
  constexpr double kColumnError = 400.0 * kFloatRoundoff;
  Features f{};
  for (std::size_t i = 0; i < fit.used.size(); ++i) f[i] = features[fit.used[i]];
  const Features leverage = solveTriangle(fit, f, true);
  const Features inverse = solveTriangle(fit, leverage, false);
  BmfrResult result;
  result.undecided = fit.undecided;
  result.leverage = length(leverage) * length(leverage);
  for (int c = 0; c < 3; ++c) {
    double moved = 0.0;
    double matrixLength = 0.0;
    double coefficientSum = 0.0;
    for (std::size_t i = 0; i < fit.used.size(); ++i) {
      result.colour[c] += fit.coefficients[c][i] * f[i];
      moved += std::abs(fit.coefficients[c][i]) * fit.columnLength[i];
      matrixLength += fit.columnLength[i] * fit.columnLength[i];
      coefficientSum += std::abs(fit.coefficients[c][i]);
    }
    result.error[c] = (kColumnError + featureError) *
                          (length(leverage) * moved + length(inverse) * std::sqrt(matrixLength) * fit.residual[c]) +
                      featureError * coefficientSum;
  }
  result.colour = glm::clamp(result.colour, 0.0, kLargestHalf);
  return result;
}

}  // namespace

Image<BmfrResult> bmfrFit(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec3>& lighting,
                          const BmfrFitSettings& settings) {
  const bool stochastic = settings.rankHandling == RankHandling::Stochastic;
  const double noiseAmplitude = stochastic ? double(settings.noiseAmplitude) : 0.0;
  const double tolerance = stochastic ? 1e-4 : double(settings.rankTolerance);
  const auto& offset = kOffsets[frame.constants.frameIndex % kOffsets.size()];

  Image<BmfrResult> results(guides.size());
  forEachPixel(guides.size() / kBlockSize + 2, [&](glm::ivec2 block) {
    const glm::ivec2 origin = block * kBlockSize - kBlockSize / 2 + glm::ivec2(offset[0], offset[1]);
    const std::vector<Sample> samples = samplesOf(frame, guides, lighting, origin);
    const Scaling scaling = scalingOf(samples, guides, double(settings.extentFloor));
    std::vector<Column> features(kFeatures);
    std::array<Column, 3> colours;
    double featureError = 0.0;
    for (int index = 0; index < int(samples.size()); ++index) {
      const Sample& s = samples[index];
      if (!s.counts) continue;
      // Positions are rounded before the centre is taken off: a few roundoffs of the distance, scaled as the block is.
      const glm::dvec3 magnitude = (glm::abs(s.position) + glm::length(s.position)) * scaling.scale;
      featureError =
          std::max(featureError, 8.0 * kFloatRoundoff * std::max({1.0, magnitude.x, magnitude.y, magnitude.z}));
      const Features f = featuresOf(s, scaling);
      const Features noise = noiseOf(index, block, frame.constants.frameIndex);
      for (int k = 0; k < kFeatures; ++k) features[k].push_back(f[k] + noiseAmplitude * noise[k]);
      for (int c = 0; c < 3; ++c) colours[c].push_back(s.colour[c]);
    }
    const Fit fit = solve(features, colours, tolerance);
    for (const Sample& s : samples) {
      if (!results.contains(s.place)) continue;
      if (guides[s.place].depth == 0.0) {
        results[s.place].colour = isFinite(lighting[s.place]) ? lighting[s.place] : glm::dvec3(0.0);
        continue;
      }
      results[s.place] = evaluate(fit, featuresOf(s, scaling), featureError);
    }
  });
  return results;
}

}  // namespace walr::reference
