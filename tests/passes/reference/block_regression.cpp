#include "tests/passes/reference/block_regression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "tests/passes/reference/hash.h"
#include "tests/passes/reference/linear_system.h"
#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

constexpr int kFeatures = 5;
constexpr int kDepthFeature = 3;
constexpr int kOcclusionFeature = 4;
using Features = Vector<kFeatures>;

/// Representative pixel of a block or cell, and its window: for every pixel of the image, the weight of its samples.
struct Block {
  bool surface = false;
  glm::ivec2 pixel{0};
  double depth = 0.0;
  glm::dvec3 normal{0.0};
  std::vector<double> window;
};

/// A fit (passes/WALR.md, 5): colour = constant + slope^T features.
struct Fit {
  double samples = 0.0;
  double depth = 0.0;
  glm::dvec3 constant{0.0};
  std::array<glm::dvec3, kFeatures> slope{};
};

struct Inputs {
  const HostFrame& frame;
  const Image<Guide>& guides;
  const Image<glm::dvec4>& accumulated;
  const BlockRegressionSettings& settings;
  bool onLightGrid;

  /// Whether a pixel lies inside the image and counts in fits as a surface.
  [[nodiscard]] bool isShown(glm::ivec2 p) const {
    return guides.contains(p) && guides[p].depth != 0.0 && (!onLightGrid || hasLightTexel(frame, p));
  }
  /// Share of the pixels that may count.
  [[nodiscard]] double shareOfPixels() const {
    const LightPattern& light = frame.conventions.light;
    return onLightGrid ? 1.0 / (light.columns * light.rows) : 1.0;
  }

  [[nodiscard]] glm::dvec3 ray(glm::ivec2 p) const { return rayThrough(frame.constants.rayFromPixel, pixelCentre(p)); }

  /// Standard deviation of the coarse window at one sample per texel, in pixels (passes/WALR.md, 6).
  [[nodiscard]] double coarseSigma() const { return double(settings.coarseSigma) * guides.size().y; }

  /// Call `visit(weight, pixel)` for all pixels of a window.
  template <typename Visit>
  void visit(const Block& block, Visit visit) const {
    forEachPixel(guides.size(), [&](glm::ivec2 p) {
      const double w = block.window[static_cast<std::size_t>(p.y) * guides.size().x + p.x];
      if (w > 0.0) visit(w, p);
    });
  }

  /// The edge-stopping function e of passes/WALR.md, 4: 1 on the plane through pixel `centre`, 0 away from it.
  [[nodiscard]] double edgeStopping(glm::ivec2 centre, double depth, glm::dvec3 normal, glm::ivec2 p,
                                    double pDepth) const {
    const double distance = std::abs(glm::dot(normal, pDepth * ray(p) - depth * ray(centre))) / depth;
    const double near = settings.planeNear;
    const double far = settings.planeFar;
    return std::clamp((far - distance) / (far - near), 0.0, 1.0);
  }
};

/// The factor max(g . n, 0) of the weights of passes/WALR.md, 4, 5 and 8.
double facing(glm::dvec3 a, glm::dvec3 b) {
  return std::clamp(glm::dot(a, b), 0.0, 1.0);
}

/// The features X of passes/WALR.md, 4.
Features featuresAt(const Inputs& inputs, glm::ivec2 p, double relativeTo) {
  const Guide& guide = inputs.guides[p];
  const glm::dvec3 n = octahedralDecode(guide.features);
  return {n.x, n.y, n.z, relativeTo / guide.depth - 1.0, guide.occlusion};
}

/// Representative pixels of the blocks, and the weights w_p of each block's own pixels (passes/WALR.md, 4).
Image<Block> representBlocks(const Inputs& inputs) {
  const int size = static_cast<int>(inputs.settings.size);
  const glm::ivec2 pixels = inputs.guides.size();
  Image<Block> blocks((pixels + size - 1) / size);
  forEachPixel(blocks.size(), [&](glm::ivec2 b) {
    Block& block = blocks[b];
    block.window.assign(inputs.guides.pixels().size(), 0.0);
    std::vector<glm::ivec2> surfaces;  // Column by column.
    for (int i = 0; i < size * size; ++i) {
      const glm::ivec2 p = size * b + glm::ivec2(i / size, i % size);
      if (inputs.isShown(p)) surfaces.push_back(p);
    }
    if (surfaces.empty()) return;
    const glm::uvec4 key(b, inputs.frame.constants.frameIndex, 0);
    block.pixel = surfaces[hashBelow(key, static_cast<std::uint32_t>(surfaces.size()))];
    const Guide& chosen = inputs.guides[block.pixel];
    block.surface = true;
    block.depth = chosen.depth;
    block.normal = roundToShortNormal(chosen.normal);
    for (int i = 0; i < size * size; ++i) {
      const glm::ivec2 p = size * b + glm::ivec2(i % size, i / size);
      if (!inputs.isShown(p) || inputs.accumulated[p].a == 0.0) continue;
      const Guide& guide = inputs.guides[p];
      block.window[static_cast<std::size_t>(p.y) * pixels.x + p.x] =
          inputs.edgeStopping(block.pixel, block.depth, chosen.normal, p, guide.depth) *
          facing(chosen.normal, octahedralDecode(guide.features)) * inputs.accumulated[p].a;
    }
  });
  return blocks;
}

/// The moments W, X, m, C, c and V of passes/WALR.md, 4, over a window.
struct Moments {
  double samples = 0.0;
  Features meanX{};
  glm::dvec3 meanY{0.0};
  Matrix<kFeatures> covariance{};
  std::array<glm::dvec3, kFeatures> right{};  ///< Covariances of the features with the colour.
  double luminanceVariance = 0.0;
};

/// Moments of a window from its pixels.
Moments momentsOf(const Inputs& inputs, const Block& block) {
  Moments m;
  if (!block.surface) return m;
  inputs.visit(block, [&](double w, glm::ivec2 p) {
    const Features x = featuresAt(inputs, p, block.depth);
    m.samples += w;
    for (int i = 0; i < kFeatures; ++i) m.meanX[i] += w * x[i];
    m.meanY += w * glm::dvec3(inputs.accumulated[p]);
  });
  if (m.samples == 0.0) return m;
  for (double& x : m.meanX) x /= m.samples;
  m.meanY /= m.samples;
  inputs.visit(block, [&](double w, glm::ivec2 p) {
    const Features x = featuresAt(inputs, p, block.depth);
    const glm::dvec3 dy = glm::dvec3(inputs.accumulated[p]) - m.meanY;
    m.luminanceVariance += w / m.samples * luminance(dy) * luminance(dy);
    for (int i = 0; i < kFeatures; ++i) {
      const double dx = w / m.samples * (x[i] - m.meanX[i]);
      m.right[i] += dx * dy;
      for (int j = 0; j < kFeatures; ++j) m.covariance[i][j] += dx * (x[j] - m.meanX[j]);
    }
  });
  return m;
}

/// The slopes beta of passes/WALR.md, 5. The ridge also covers the rounding of covariances that are stored as halves.
std::array<glm::dvec3, kFeatures> slopesOf(const Inputs& inputs, const Moments& m) {
  Matrix<kFeatures> covariance = m.covariance;
  for (int i = 0; i < kFeatures; ++i)
    covariance[i][i] += double(inputs.settings.ridge) + kFeatures * 0x1p-11 * m.covariance[i][i];
  const Matrix<kFeatures> inverted = inverse(covariance);
  std::array<glm::dvec3, kFeatures> slopes{};
  for (int i = 0; i < kFeatures; ++i)
    for (int j = 0; j < kFeatures; ++j) slopes[i] += inverted[i][j] * m.right[j];
  return slopes;
}

/// Moments are stored as halves; this is the relative rounding error of a mean.
constexpr double kMeanRounding = 0x1p-11;

/// Growth, same_k of passes/WALR.md, 5: 1 up to `errors` standard errors of difference, 0 from twice as many.
double sameLight(double difference, double variance, double mean, double errors) {
  const double error = std::sqrt(variance + std::pow(kMeanRounding * mean, 2.0));
  if (error == 0.0) return difference == 0.0 ? 1.0 : 0.0;
  return std::clamp(2.0 - std::abs(difference) / (errors * error), 0.0, 1.0);
}

void addWindow(std::vector<double>& sum, double weight, const std::vector<double>& window) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * window[i];
}

/// Edge tracing (Meunier & Harada 2022, 3.3; passes/WALR.md, 5): the smallest weight on the way to a block. Step
/// lengths follow the edge distances that the previous iteration found.
double traceEdge(const Inputs& inputs, const Image<Block>& blocks, const Image<int>& distances, glm::ivec2 from,
                 glm::ivec2 direction, int steps, int& edge) {
  const Block& centre = blocks[from];
  double weight = 1.0;
  edge = steps + 1;
  for (int step = 0; step < steps;) {
    const int stride = static_cast<int>(inputs.settings.sdfFraction * double(distances[from + step * direction]));
    step = std::min(step + std::max(stride, 1), steps);
    const glm::ivec2 q = from + step * direction;
    const bool surface = blocks.contains(q) && blocks[q].surface;
    weight = surface ? std::min(weight, inputs.edgeStopping(centre.pixel, centre.depth, centre.normal, blocks[q].pixel,
                                                            blocks[q].depth))
                     : 0.0;
    if (weight <= 0.0) {
      edge = step;
      return 0.0;
    }
  }
  return weight;
}

/// Growth between two blocks, with the variance of their pixels together; 1 where one of them has no sample
/// (passes/WALR.md, 5).
double sameLight(const Inputs& inputs, const Moments& a, const Moments& b) {
  if (a.samples == 0.0 || b.samples == 0.0) return 1.0;
  const double difference = luminance(a.meanY - b.meanY);
  const double samples = a.samples + b.samples;
  const double within = (a.samples * a.luminanceVariance + b.samples * b.luminanceVariance) / samples;
  const double between = a.samples * b.samples * std::pow(difference / samples, 2.0);
  const double variance = (within + between) * (1.0 / a.samples + 1.0 / b.samples);
  return sameLight(difference, variance, luminance(a.meanY + b.meanY), double(inputs.settings.growthErrors));
}

/// Windows of the fine fits: all a-trous iterations over blocks (passes/WALR.md, 5).
Image<Block> fineWindows(const Inputs& inputs, Image<Block> blocks) {
  Image<int> distances(blocks.size(), 0);
  int spacing = 1;
  for (std::uint32_t t = 0; t < inputs.settings.iterations; ++t, spacing *= 3) {
    Image<Moments> moments(blocks.size());
    forEachPixel(blocks.size(), [&](glm::ivec2 b) { moments[b] = momentsOf(inputs, blocks[b]); });
    Image<Block> next = blocks;
    Image<int> nextDistances(blocks.size(), 0);
    forEachPixel(blocks.size(), [&](glm::ivec2 b) {
      if (!blocks[b].surface) return;
      int nearest = spacing + 1;
      for (int tap = 0; tap < 9; ++tap) {
        const glm::ivec2 direction(tap % 3 - 1, tap / 3 - 1);
        if (direction == glm::ivec2(0)) continue;
        int edge = 0;
        const double traced = traceEdge(inputs, blocks, distances, b, direction, spacing, edge);
        nearest = std::min(nearest, edge);
        if (traced <= 0.0) continue;
        const Block& q = blocks[b + spacing * direction];
        const double weight = traced * facing(blocks[b].normal, q.normal);
        addWindow(next[b].window, weight * sameLight(inputs, moments[b], moments[b + spacing * direction]), q.window);
      }
      nextDistances[b] = std::min(nearest, 31);
    });
    blocks = std::move(next);
    distances = std::move(nextDistances);
  }
  return blocks;
}

/// The union of weighted windows; its depth is their harmonic mean.
class Union {
 public:
  explicit Union(std::size_t pixels) { block_.window.assign(pixels, 0.0); }

  void add(double weight, const Block& other) {
    if (!other.surface) return;
    addDepth(weight, other.depth);
    addWindow(block_.window, weight, other.window);
  }
  void addPixel(std::size_t pixel, double depth, double samples) {
    addDepth(1.0, depth);
    block_.window[pixel] = samples;
  }
  [[nodiscard]] Block block() && {
    block_.surface = weights_ > 0.0;
    if (block_.surface) block_.depth = weights_ / inverse_;
    return std::move(block_);
  }

 private:
  void addDepth(double weight, double depth) {
    weights_ += weight;
    inverse_ += weight / depth;
  }

  Block block_;
  double weights_ = 0.0;
  double inverse_ = 0.0;
};

/// Sample count W of a window.
double samplesOf(const Block& block) {
  return std::accumulate(block.window.begin(), block.window.end(), 0.0);
}

/// Standard deviation of a coarse window in cells, sigma of passes/WALR.md, 6.
double coarseSigma(const Inputs& inputs, int cellSize, double samples) {
  const double perTexel = std::max(samples / (cellSize * cellSize) / inputs.shareOfPixels(), 1.0);
  return std::max(inputs.coarseSigma() / cellSize * std::pow(perTexel, -double(inputs.settings.coarseNarrowing)), 0.5);
}

/// Separable Gaussian windows around cells, which no edge ends (passes/WALR.md, 6). Depths are harmonic means, first of
/// the pixels of a cell, then of rows, then of columns.
Image<Block> coarseWindows(const Inputs& inputs, int cellSize) {
  const glm::ivec2 size = inputs.guides.size();
  const std::size_t pixels = inputs.guides.pixels().size();
  Image<Block> cells((size + cellSize - 1) / cellSize);
  forEachPixel(cells.size(), [&](glm::ivec2 cell) {
    Union pixelsOfCell(pixels);
    for (int i = 0; i < cellSize * cellSize; ++i) {
      const glm::ivec2 p = cellSize * cell + glm::ivec2(i % cellSize, i / cellSize);
      if (!inputs.isShown(p)) continue;
      pixelsOfCell.addPixel(static_cast<std::size_t>(p.y) * size.x + p.x, inputs.guides[p].depth,
                            inputs.accumulated[p].a);
    }
    cells[cell] = std::move(pixelsOfCell).block();
  });
  const auto blur = [&](const Image<Block>& from, glm::ivec2 axis) {
    Image<Block> to(from.size());
    forEachPixel(from.size(), [&](glm::ivec2 cell) {
      const double sigma = coarseSigma(inputs, cellSize, samplesOf(from[cell]));
      const int radius = static_cast<int>(std::ceil(double(inputs.settings.coarseReach) * sigma));
      const auto gaussian = [&](int i) { return std::exp(-0.5 * i * i / (sigma * sigma)); };
      double weights = 0.0;
      for (int i = -radius; i <= radius; ++i) weights += from.contains(cell + i * axis) ? gaussian(i) : 0.0;
      Union window(pixels);
      for (int i = -radius; i <= radius; ++i) {
        if (from.contains(cell + i * axis)) window.add(gaussian(i) / weights, from[cell + i * axis]);
      }
      to[cell] = std::move(window).block();
    });
    return to;
  };
  return blur(blur(cells, {1, 0}), {0, 1});
}

/// Share s of the coarse fit (passes/WALR.md, 8).
double coarseShare(const BlockRegressionSettings& settings, double samples) {
  const double coarse = double(settings.coarseSamples);
  const double share = coarse / (samples + coarse);
  return share * std::clamp(share / double(settings.coarseLeastShare) - 1.0, 0.0, 1.0);
}

/// Whether some pixel reads this cell's fit: next to converged blocks alone, none does.
bool isRead(const Inputs& inputs, int cellSize, glm::ivec2 cell, const Image<Fit>& fine) {
  const double blockSize = inputs.settings.size;
  const glm::dvec2 centre = (glm::dvec2(cell) + 0.5) * double(cellSize);
  bool read = false;
  forEachPixel(fine.size(), [&](glm::ivec2 b) {
    // A pixel reads cells whose centres are less than a cell away and blocks whose centres are less than a block away.
    // The factor allows for the rounding of a block's stored sample count.
    const glm::dvec2 way = glm::abs((glm::dvec2(b) + 0.5) * blockSize - centre);
    if (std::max(way.x, way.y) >= cellSize + blockSize || fine[b].depth == 0.0) return;
    read = read || coarseShare(inputs.settings, fine[b].samples * (1.0 - 0x1p-10)) > 0.0;
  });
  return read;
}

/// Growth of the coarse windows (passes/WALR.md, 7): 5 x 5 taps, 3 cells apart, join a cell's window if the cell's fit
/// predicts their mean luminance.
Image<Block> growCoarseWindows(const Inputs& inputs, int cellSize, const Image<Block>& cells, const Image<Fit>& fine) {
  constexpr double kTapSigma = 1.2;
  constexpr double kLeastNoise = 0.05;
  Image<Moments> moments(cells.size());
  forEachPixel(cells.size(), [&](glm::ivec2 cell) { moments[cell] = momentsOf(inputs, cells[cell]); });
  Image<Block> grown = cells;
  forEachPixel(cells.size(), [&](glm::ivec2 cell) {
    const Moments& own = moments[cell];
    if (own.samples == 0.0 || !isRead(inputs, cellSize, cell, fine)) return;
    const std::array<glm::dvec3, kFeatures> slopes = slopesOf(inputs, own);
    double left = own.luminanceVariance;
    for (int i = 0; i < kFeatures; ++i) left -= luminance(slopes[i]) * luminance(own.right[i]);
    const double noise = own.luminanceVariance > 0.0 ? std::clamp(left / own.luminanceVariance, kLeastNoise, 1.0) : 1.0;
    const double perPixel = own.samples / (cellSize * cellSize);
    const double sigma = cellSize * coarseSigma(inputs, cellSize, own.samples);
    const double pixels = 4.0 * glm::pi<double>() * sigma * sigma * std::min(perPixel, inputs.shareOfPixels());
    const double errors = double(inputs.settings.coarseGrowthErrors) /
                          (1.0 + double(inputs.settings.coarseGrowthOcclusion) * own.meanX[kOcclusionFeature]);
    for (int i = 0; i < 25; ++i) {
      const glm::ivec2 tap(i % 5 - 2, i / 5 - 2);
      const glm::ivec2 q = cell + 3 * tap;
      if (tap == glm::ivec2(0) || !cells.contains(q) || moments[q].samples == 0.0) continue;
      const Moments& other = moments[q];
      double difference = luminance(other.meanY - own.meanY);
      for (int k = 0; k < kFeatures; ++k) {
        double x = other.meanX[k];
        if (k == kDepthFeature) x = (x + 1.0) * cells[cell].depth / cells[q].depth - 1.0;
        difference -= luminance(slopes[k]) * (x - own.meanX[k]);
      }
      const double same = sameLight(difference, noise * (own.luminanceVariance + other.luminanceVariance) / pixels,
                                    luminance(own.meanY + other.meanY), errors);
      const double distance = glm::length(glm::dvec2(tap)) / kTapSigma;
      addWindow(grown[cell].window, same * std::exp(-0.5 * distance * distance), cells[q].window);
    }
  });
  return grown;
}

/// The fit f of passes/WALR.md, 5: weighted least squares over a window.
Fit fitOf(const Inputs& inputs, const Block& block) {
  Fit fit;
  if (!block.surface) return fit;
  fit.depth = block.depth;
  const Moments m = momentsOf(inputs, block);
  fit.samples = m.samples;
  if (m.samples == 0.0) return fit;
  fit.slope = slopesOf(inputs, m);
  fit.constant = m.meanY;
  for (int i = 0; i < kFeatures; ++i) fit.constant -= fit.slope[i] * m.meanX[i];
  return fit;
}

/// Evaluate a fit with a pixel's own features: max(f(X_p), 0) of passes/WALR.md, 8.
glm::dvec3 evaluate(const Inputs& inputs, const Fit& fit, glm::ivec2 p) {
  const Features x = featuresAt(inputs, p, fit.depth);
  glm::dvec3 colour = fit.constant;
  for (int i = 0; i < kFeatures; ++i) colour += fit.slope[i] * x[i];
  return glm::max(colour, glm::dvec3(0.0));
}

/// Visit the four blocks or cells of `size` pixels around a pixel, with their bilinear weights.
template <typename Visit>
void forFourNeighbours(glm::ivec2 p, int size, const Image<Fit>& grid, Visit visit) {
  const glm::dvec2 position = (glm::dvec2(p) + 0.5) / double(size) - 0.5;
  const glm::ivec2 base = glm::ivec2(glm::floor(position));
  const glm::dvec2 f = position - glm::dvec2(base);
  for (const glm::ivec2 offset : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
    if (!grid.contains(base + offset)) continue;
    visit(base + offset, (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y));
  }
}

}  // namespace

Image<glm::dvec3> blockRegression(const HostFrame& frame, const Image<Guide>& guides,
                                  const Image<glm::dvec4>& accumulated, const BlockRegressionSettings& settings,
                                  bool onLightGrid) {
  const Inputs inputs{frame, guides, accumulated, settings, onLightGrid};
  const Image<Block> blocks = representBlocks(inputs);
  const auto fitAll = [&](const Image<Block>& windows) {
    Image<Fit> fits(windows.size());
    forEachPixel(windows.size(), [&](glm::ivec2 b) { fits[b] = fitOf(inputs, windows[b]); });
    return fits;
  };
  const LightPattern& light = frame.conventions.light;
  const double texel = onLightGrid ? std::min(light.columns, light.rows) : 1.0;
  const double cellPixels = std::min(inputs.coarseSigma() / double(settings.coarseResolution), 8.0 * texel);
  int cellSize = int(settings.size);
  while (2 * cellSize <= cellPixels && cellSize <= 2 * int(settings.size)) cellSize *= 2;
  const Image<Fit> fine = fitAll(fineWindows(inputs, blocks));
  const Image<Fit> coarse = fitAll(growCoarseWindows(inputs, cellSize, coarseWindows(inputs, cellSize), fine));

  Image<glm::dvec3> result(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    result[p] = glm::dvec3(accumulated[p]);
    const Guide& guide = guides[p];
    if (guide.depth == 0.0) return;
    glm::dvec3 fineSum(0.0);
    glm::dvec3 coarseSum(0.0);
    double fineWeight = 0.0;
    double coarseWeight = 0.0;
    double samples = 0.0;
    forFourNeighbours(p, cellSize, coarse, [&](glm::ivec2 cell, double bilinear) {
      if (coarse[cell].samples == 0.0) return;
      coarseSum += bilinear * evaluate(inputs, coarse[cell], p);
      coarseWeight += bilinear;
    });
    forFourNeighbours(p, int(settings.size), fine, [&](glm::ivec2 b, double bilinear) {
      if (fine[b].samples == 0.0) return;
      const double weight = bilinear * facing(blocks[b].normal, octahedralDecode(guide.features)) *
                            inputs.edgeStopping(blocks[b].pixel, blocks[b].depth, blocks[b].normal, p, guide.depth);
      fineSum += weight * evaluate(inputs, fine[b], p);
      samples += weight * fine[b].samples;
      fineWeight += weight;
    });
    if (coarseWeight > 0.0) result[p] = coarseSum / coarseWeight;
    if (fineWeight > 0.0) {
      const double share = coarseWeight > 0.0 ? coarseShare(settings, samples / fineWeight) : 0.0;
      result[p] = glm::mix(fineSum / fineWeight, result[p], share);
    }
  });
  return result;
}

}  // namespace walr::reference
