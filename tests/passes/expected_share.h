#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shaders/temporal/antilag.h"
#include "tests/passes/block_filter.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/residual_light.h"
#include "tests/passes/synthetic_scene.h"

/// The share of accumulated light in the result in double precision (passes/WALR.md, 9), and the filter that is held to
/// it.
namespace walr::test::accumulated_share_test {

using reference::Image;

class FilterOf {
 public:
  FilterOf(const fg::test::TestDevice& device, const Scene& scene, bool share)
      : frame_(renderStill(scene, kSize)),
        guides_(reference::prepareGuides(frame_, reference::Storage::Quantised, {}, kOcclusionInSmallImages)),
        run_(
            device, kSize, 2,
            [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
              BlockLight light{.accumulated = inputs[0], .alpha = LightingAlpha::SampleCount, .lighting = inputs[1]};
              // Tells the share that no history is longer.
              light.history = declareSteeredHistory(graph, graph.textureDesc(inputs[0]).extent, float(kSamples));
              BlockRegressionSettings settings{.size = kBlock, .iterations = 2, .coarseSigma = 0.15F};
              settings.share.enabled = share;
              return addBlockFilter(graph, frame, light, guides, settings);
            },
            true) {}

  Image<glm::dvec4> filter(const ResidualLight& light, std::uint32_t frameIndex = 0) {
    frame_.constants.frameIndex = frameIndex;
    return run_.run(frame_, guides_, {light.mean, light.lighting});
  }
  /// The result once the statistics are those of this light.
  Image<glm::dvec4> settled(const ResidualLight& light) {
    static_cast<void>(filter(light));
    return filter(light);
  }
  [[nodiscard]] const Image<reference::Guide>& guides() const { return guides_; }
  [[nodiscard]] const FrameConstants& constants() const { return frame_.constants; }

 private:
  reference::HostFrame frame_;
  Image<reference::Guide> guides_;
  FilterRun run_;
};

/// Residuals of a pixel or their means over pixels: luminances of y - p, h - p and m - p.
struct Residual {
  double noisy = 0.0, history = 0.0, mean = 0.0;
};
inline Residual operator-(const Residual& a, const Residual& b) {
  return {a.noisy - b.noisy, a.history - b.history, a.mean - b.mean};
}

/// Sums of a level: what the fits miss, and the noise of one sample, both squared.
struct Level {
  double missed = 0.0, noise = 0.0;
  void add(const Level& other, double weight) {
    missed += weight * other.missed;
    noise += weight * other.noise;
  }
};
/// The roots and the cubes of sums, which are stored and interpolated as roots.
inline Level cubeRoot(const Level& l) {
  return {std::cbrt(l.missed), std::cbrt(l.noise)};
}
inline Level cube(const Level& l) {
  return {l.missed * l.missed * l.missed, l.noise * l.noise * l.noise};
}
inline Level levelOf(const Residual& r) {
  const double missed = r.noisy * r.history;
  return {missed, kSamples * (r.mean * r.mean - missed)};
}

/// The mean around the pixel, then the pixel's difference from it.
using Levels = std::array<Level, 2>;
/// Pixels with the same surface all around, then pixels beside an edge.
using Classes = std::array<Levels, 2>;

inline glm::ivec2 tileOf(glm::ivec2 p) {
  return (p + kBefore) / kTile;
}
inline const glm::ivec2 kTiles = tileOf(kSize - 1) + 1;

/// What is known of every tile: sums over the window around it.
struct Statistics {
  Image<Classes> levels{kTiles};
  Image<glm::dvec2> far{kTiles};  ///< Products two pixels apart, by axis.
  Image<double> light{kTiles};    ///< Predicted luminance, summed over the pixels of the window.
};

/// 1 where the agreement of light and history goes on from pixel to pixel, 0 where it is noise that both share.
inline double trustIn(const Classes& sums, glm::dvec2 far) {
  const double around = sums[0][0].missed + sums[1][0].missed, detail = sums[0][1].missed + sums[1][1].missed;
  const double continuing = std::max(around, 0.0) + 1.25 * std::max(std::abs(far.x), std::abs(far.y));
  return std::clamp((continuing / std::max(around + detail, 1e-30) - 0.75) / 0.2, 0.0, 1.0);
}

/// What the fits miss, times `gain`, and the noise of a mean of samples.
inline Level weighed(const Level& level, double samples, double gain) {
  return {gain * std::max(level.missed, 0.0), std::max(level.noise, 0.0) / samples};
}
inline double bestShare(const Level& weighed, double trust) {
  return trust * weighed.missed / std::max(weighed.missed + weighed.noise, 1e-30);
}

/// What the result is, in double precision, if the camera stands still and all pixels have kSamples samples. The
/// statistics are those of earlier frames that all had this light and this prediction, unless others are given.
class ExpectedResult {
 public:
  ExpectedResult(const FilterOf& filter, const ResidualLight& light, const Image<glm::dvec4>& predicted)
      : guides_(filter.guides()), constants_(filter.constants()) {
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const double y = luminanceOf(light.lighting[p]), m = luminanceOf(light.mean[p]), x = luminanceOf(predicted[p]);
      const double h = (kSamples * m - y) / (kSamples - 1.0);
      own_[p] = {y - x, h - x, m - x};
    });
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { lookAround(p); });
    sumOverTiles(predicted);
    statistics_ = statistics([](glm::ivec2) { return true; });
  }

  /// Sums over the windows around all tiles, of the tiles that take part.
  template <typename TakesPart>
  [[nodiscard]] Statistics statistics(const TakesPart& takesPart) const {
    Statistics sums;
    reference::forEachPixel(kTiles, [&](glm::ivec2 t) {
      reference::forEachPixel(kTiles, [&](glm::ivec2 q) {
        if (!takesPart(q)) return;
        const double weight = weightOf(q, t), scale = weight * pixels_[q] / tileLight_[q];
        for (int axis = 0; axis < 2; ++axis) {
          const glm::dvec2 products = products_[axis][q];
          sums.far[t][axis] += scale * products.x * std::min(pixels_[q] / std::max(products.y, 1.0), 4.0);
        }
        for (int c = 0; c < 2; ++c) {
          for (int level = 0; level < 2; ++level) sums.levels[t][c][level].add(tiles_[q][c][level], scale);
        }
        sums.light[t] += weight * tileLight_[q];
      });
    });
    return sums;
  }

  /// Luminance that the result has more than the prediction, by level.
  [[nodiscard]] std::array<double, 2> added(glm::ivec2 p) const { return added(p, statistics_, kSamples); }
  /// The same with other statistics, of pixels that have `samples` samples, as have those around them.
  [[nodiscard]] std::array<double, 2> added(glm::ivec2 p, const Statistics& statistics, double samples) const {
    const glm::dvec2 at = (glm::dvec2(p) + 0.5 + double(kBefore)) / double(kTile) - 0.5;
    const glm::dvec2 base = glm::floor(at), f = at - base;
    Levels known;
    double trust = 0.0;
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 corner(i & 1, i >> 1);
      const double weight = (corner.x == 1 ? f.x : 1.0 - f.x) * (corner.y == 1 ? f.y : 1.0 - f.y);
      const glm::ivec2 tile = glm::clamp(glm::ivec2(base) + corner, glm::ivec2(0), kTiles - 1);
      for (int level = 0; level < 2; ++level) {
        known[level].add(cubeRoot(statistics.levels[tile][edges_[p]][level]), weight);
      }
      trust += weight * trustIn(statistics.levels[tile], statistics.far[tile]);
    }
    const double around = around_[p].mean;
    const AccumulatedShareSettings settings;
    const double aroundGain = besideEdge(p) ? settings.edgeGain : settings.gain;
    return {shareOf(cube(known[0]), trust, samples, aroundGain) * around,
            shareOf(cube(known[1]), trust, samples, settings.gain) * (own_[p].mean - around)};
  }
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  /// Sum of the residuals that the shares multiply, as absolute values.
  [[nodiscard]] double residuals(glm::ivec2 p) const {
    return std::abs(around_[p].mean) + std::abs(own_[p].mean - around_[p].mean);
  }
  /// Whether some tile is trusted in part only.
  [[nodiscard]] bool trustsInPart() const {
    bool found = false;
    reference::forEachPixel(kTiles, [&](glm::ivec2 t) {
      const double trust = trustIn(statistics_.levels[t], statistics_.far[t]);
      found = found || (trust > 0.1 && trust < 0.9);
    });
    return found;
  }
  [[nodiscard]] bool hasEdges(glm::ivec2 tile) const {
    const Levels& sums = tiles_[tile][1];
    return sums[0].missed != 0.0 || sums[0].noise != 0.0 || sums[1].missed != 0.0 || sums[1].noise != 0.0;
  }
  [[nodiscard]] bool besideEdge(glm::ivec2 p) const { return edges_[p] != 0; }
  /// How far anti-aliasing shortens its history in a tile of antilag, and how far the device may be from this.
  [[nodiscard]] std::pair<double, double> shortening(glm::ivec2 tileOfAntilag) const {
    const glm::ivec2 tile = glm::min(tileOf(kAntilagTile * tileOfAntilag + kAntilagTile / 2), kTiles - 1);
    Level all;
    for (const Levels& levels : statistics_.levels[tile]) {
      for (const Level& level : levels) all.add(level, 1.0);
    }
    const AccumulatedShareSettings settings;
    const auto [missed, noise] = weighed(all, kSamples, settings.gain);
    const double share = bestShare({missed, noise}, trustIn(statistics_.levels[tile], statistics_.far[tile]));
    // The device's residuals differ from the test's by 2^-11 of the light (toleranceOf). Relative to the light, y - p
    // has a mean square of about 1 and h - p one of 1/7, so that the mean of their product differs by at most (1 + .4)
    // 2^-11, and that of (m - p)^2, 1/8, by .7 x 2^-11.
    const double ofMissed = settings.gain * 1.4 * std::exp2(-11.0) * statistics_.light[tile];
    const double ofNoise = (1.4 + 0.7) * std::exp2(-11.0) * statistics_.light[tile];
    const double ofShare = (ofMissed * noise + ofNoise * missed) / ((missed + noise) * (missed + noise));
    constexpr double kRange = 0.5;
    return {std::clamp((share - settings.antialiasingShare) / kRange, 0.0, 1.0), ofShare / kRange + std::exp2(-11.0)};
  }

 private:
  /// Weight of a tile in the window around another one: it falls to 0 with the distance along each axis.
  static double weightOf(glm::ivec2 tile, glm::ivec2 middle) {
    const glm::dvec2 distance = glm::abs(tile - middle);
    const glm::dvec2 weight = glm::max(1.0 - distance / (AccumulatedShareSettings{}.radius + 1.0), 0.0);
    return weight.x * weight.y;
  }

  [[nodiscard]] double shareOf(const Level& level, double trust, double samples, double gain) const {
    const double least = AccumulatedShareSettings{}.leastShare;
    const double share = bestShare(weighed(level, samples, gain), trust);
    return std::clamp((share - least) / (1.0 - least), 0.0, 1.0);
  }

  [[nodiscard]] glm::dvec3 positionOf(glm::ivec2 p) const {
    return guides_[p].depth * reference::rayThrough(constants_.rayFromPixel, reference::pixelCentre(p));
  }

  /// How far q shows the surface of p.
  [[nodiscard]] double same(glm::ivec2 p, glm::ivec2 q) const {
    if (guides_[q].depth == 0.0) return 0.0;
    const BlockRegressionSettings planes;
    const glm::dvec3 n = reference::octahedralDecode(guides_[p].features);
    const double distance = std::abs(dot(n, positionOf(q) - positionOf(p))) / guides_[p].depth;
    const double onPlane = (planes.planeFar - distance) / (planes.planeFar - planes.planeNear);
    const double facing = 5.0 * dot(n, reference::octahedralDecode(guides_[q].features)) - 4.0;
    return std::clamp(onPlane, 0.0, 1.0) * std::clamp(facing, 0.0, 1.0);
  }

  void lookAround(glm::ivec2 p) {
    double weights = 0.0;
    for (int i = 0; i < 9; ++i) {
      const glm::ivec2 q = p + glm::ivec2(i % 3, i / 3) - 1;
      const bool inside = q.x >= 0 && q.y >= 0 && q.x < kSize.x && q.y < kSize.y;
      if (!inside || tileOf(q) != tileOf(p)) continue;
      const double weight = same(p, q);
      if (weight < 0.5) edges_[p] = 1;
      around_[p].noisy += weight * own_[q].noisy;
      around_[p].history += weight * own_[q].history;
      around_[p].mean += weight * own_[q].mean;
      weights += weight;
    }
    around_[p] = {around_[p].noisy / weights, around_[p].history / weights, around_[p].mean / weights};
  }

  /// Product of the residuals of light and history two pixels apart in the tile, and 1; 0 if they show different
  /// surfaces.
  [[nodiscard]] glm::dvec2 farProduct(glm::ivec2 p, int axis) const {
    glm::ivec2 q = p;
    q[axis] += (p[axis] + kBefore) % kTile + 2 < kTile ? 2 : -2;
    const bool inside = q.x < kSize.x && q.y < kSize.y;
    if (!inside || same(p, q) < 0.5) return glm::dvec2(0.0);
    return {0.5 * (own_[p].noisy * own_[q].history + own_[p].history * own_[q].noisy), 1.0};
  }

  void sumOverTiles(const Image<glm::dvec4>& predicted) {
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const glm::ivec2 t = tileOf(p);
      Levels& sums = tiles_[t][edges_[p]];
      sums[0].add(levelOf(around_[p]), 1.0);
      sums[1].add(levelOf(own_[p] - around_[p]), 1.0);
      for (int axis = 0; axis < 2; ++axis) products_[axis][t] += farProduct(p, axis);
      tileLight_[t] += luminanceOf(predicted[p]);
      pixels_[t] += 1.0;
    });
  }

  const Image<reference::Guide>& guides_;
  FrameConstants constants_;
  Image<Residual> own_{kSize}, around_{kSize};
  Image<int> edges_{kSize};
  Image<Classes> tiles_{kTiles};
  std::array<Image<glm::dvec2>, 2> products_{Image<glm::dvec2>(kTiles), Image<glm::dvec2>(kTiles)};  ///< By axis.
  Image<double> tileLight_{kTiles}, pixels_{kTiles};
  Statistics statistics_;
};

/// Statistics over frames while the camera stands still. Tiles without a share are quiet: they are measured in two of
/// sixteen frames.
class MeasuredFrames {
 public:
  [[nodiscard]] const Statistics& statistics() const { return sums_; }
  [[nodiscard]] int quietTiles() const {
    int count = 0;
    reference::forEachPixel(kTiles, [&](glm::ivec2 t) { count += quiet_[t]; });
    return count;
  }
  [[nodiscard]] bool takesPart(glm::ivec2 tile, std::uint32_t frameIndex) const {
    return quiet_[tile] == 0 || (tile.x + 3 * tile.y + 5 * int(frameIndex / 2)) % 8 == 0;
  }

  void add(const ExpectedResult& frame, std::uint32_t frameIndex) {
    const AccumulatedShareSettings settings;
    Statistics now = frame.statistics([&](glm::ivec2 tile) { return takesPart(tile, frameIndex); });
    Image<int> quiet(kTiles);
    reference::forEachPixel(kTiles, [&](glm::ivec2 t) {
      const double kept = 1.0 - 1.0 / (settings.frames * (quiet_[t] == 0 ? 1.0 : 2.0));
      Classes& levels = now.levels[t];
      now.far[t] += kept * sums_.far[t];
      now.light[t] += kept * sums_.light[t];
      for (int c = 0; c < 2; ++c) {
        for (int level = 0; level < 2; ++level) levels[c][level].add(sums_.levels[t][c][level], kept);
      }
      const bool hasEdges = takesPart(t, frameIndex) && frame.hasEdges(t);
      withEdges_[t] = hasEdges ? 16 : std::max(withEdges_[t] - 1, 0);
      const double trust = trustIn(levels, now.far[t]);
      double most = 0.0;
      for (int c = 0; c < (withEdges_[t] == 0 ? 1 : 2); ++c) {
        const std::array gains{c == 1 ? settings.edgeGain : settings.gain, settings.gain};
        for (int level = 0; level < 2; ++level) {
          most = std::max(most, bestShare(weighed(levels[c][level], kSamples, gains[level]), trust));
        }
      }
      const double quietShare = 0.75 * settings.leastShare;
      EXPECT_GT(std::abs(most / quietShare - 1.0), 0.002)
          << t.x << ", " << t.y;  // The device's rounding decides nothing.
      quiet[t] = most < quietShare ? 1 : 0;
    });
    quiet_ = quiet;
    sums_ = std::move(now);
  }

 private:
  Statistics sums_;
  Image<int> quiet_{kTiles}, withEdges_{kTiles};
};

/// How far the result of a pixel with this light may be from double precision.
/// @param residuals ExpectedResult::residuals
/// @param partly    ExpectedResult::trustsInPart
inline double toleranceOf(double light, double residuals, bool partly) {
  // The prediction and the result are rounded to halves. The device measures its statistics before this rounding, so
  // that its residuals differ from the test's by 2^-11 of the light. Root mean squares of residuals are above half of
  // the light here, so that mean squares differ by less than 2^-9, and by twice 2^-10 where they are stored as cube
  // roots. A share is x / (x + 1), where x is a ratio of two such means: it differs by at most a quarter of 2^-7.
  // Trust, where it is between 0 and 1, is a ratio divided by .2. The product of both is divided by 1 - least share.
  const double shareError = std::exp2(-9.0) + (partly ? 5.0 * std::exp2(-8.0) : 0.0);
  const double least = AccumulatedShareSettings{}.leastShare;
  return 2.0 * std::exp2(-11.0) * light + shareError / (1.0 - least) * residuals;
}

inline double rmsError(const Image<glm::dvec4>& image, const Image<glm::dvec4>& truth) {
  double squares = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { squares += std::pow(image[p].g - truth[p].g, 2.0); });
  return std::sqrt(squares / (kSize.x * kSize.y));
}

}  // namespace walr::test::accumulated_share_test
