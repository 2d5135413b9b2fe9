// The share of accumulated light in the result (passes/WALR_EXPERIMENTS.md): against a calculation in double
// precision, and by what it is for.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/passes/block_filter.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::Image;

constexpr glm::ivec2 kSize(61, 43);  // Not a multiple of the tiles.
constexpr std::uint32_t kBlock = 4;
constexpr int kTile = 8;    // Pixels per axis: two blocks.
constexpr int kBefore = 2;  // Pixels of the first tile before the image: half a block.
constexpr double kSamples = 8.0;

double luminanceOf(const glm::dvec4& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

/// The light that a filter reads: this frame's, and its mean with a history of kSamples - 1 frames.
struct Light {
  Image<glm::dvec4> truth{kSize};
  Image<glm::dvec4> lighting{kSize};
  Image<glm::dvec4> mean{kSize};
};

/// Light with stripes of two pixels that no guide shows, and with noise.
/// @param stripes difference of the stripes from their mean, over this mean
/// @param noise   standard deviation of one sample over its mean
Light stripedLight(double stripes, double noise) {
  std::mt19937 random(7);
  // A gamma distribution has this relative deviation at the shape 1 / noise^2; the sum of n samples is n times the
  // shape.
  const auto meanOf = [&](double samples) {
    if (noise == 0.0) return 1.0;
    const double shape = samples / (noise * noise);
    return std::gamma_distribution<double>(shape, 1.0 / shape)(random);
  };
  Light light;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double truth = 1.0 + stripes * (p.x / 2 % 2 == 0 ? 1.0 : -1.0);
    const double y = reference::roundToHalf(truth * meanOf(1.0));
    const double h = truth * meanOf(kSamples - 1.0);
    const double m = reference::roundToHalf(h + (y - h) / kSamples);
    light.truth[p] = glm::dvec4(glm::dvec3(truth), 1.0);
    light.lighting[p] = glm::dvec4(glm::dvec3(y), 1.0);
    light.mean[p] = glm::dvec4(glm::dvec3(m), kSamples);
  });
  return light;
}

class FilterOfWall {
 public:
  FilterOfWall(const fg::vk::Device& device, bool residual)
      : frame_(renderStill(flatWall(), kSize)),
        guides_(reference::prepareGuides(frame_, reference::Storage::Quantised, {}, kOcclusionInSmallImages)),
        run_(device, kSize, 2, [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
          const BlockLight light{.accumulated = inputs[0], .alpha = LightingAlpha::SampleCount, .lighting = inputs[1]};
          return addBlockFilter(graph, frame, light, guides,
                                {.size = kBlock, .iterations = 2, .coarseSigma = 0.15F, .residual = residual});
        }) {}

  Image<glm::dvec4> filter(const Light& light) { return run_.run(frame_, guides_, {light.mean, light.lighting}); }

 private:
  reference::HostFrame frame_;
  Image<reference::Guide> guides_;
  FilterRun run_;
};

/// What a tile adds to the statistics: product and square of the residuals, over the square of the light, and pixels.
struct Tile {
  double product = 0.0, square = 0.0, pixels = 0.0;
};

/// The shares of all pixels under a still camera, if every frame so far had this light and this prediction.
Image<double> sharesOf(const Light& light, const Image<glm::dvec4>& predicted,
                       const BlockRegressionSettings& settings) {
  const auto tileOf = [](int pixel) { return (pixel + kBefore) / kTile; };
  const glm::ivec2 grid(tileOf(kSize.x - 1) + 1, tileOf(kSize.y - 1) + 1);
  Image<Tile> tiles(grid);
  Image<double> lights(grid);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double y = luminanceOf(light.lighting[p]), m = luminanceOf(light.mean[p]), x = luminanceOf(predicted[p]);
    const double h = (kSamples * m - y) / (kSamples - 1.0);
    const glm::ivec2 t(tileOf(p.x), tileOf(p.y));
    tiles[t].product += (y - x) * (h - x);
    tiles[t].square += (m - x) * (m - x);
    tiles[t].pixels += 1.0;
    lights[t] += x;
  });
  const int radius = static_cast<int>(settings.residualRadius);
  Image<double> product(grid), square(grid);
  reference::forEachPixel(grid, [&](glm::ivec2 t) {
    double pixels = 0.0;
    for (int y = std::max(t.y - radius, 0); y <= std::min(t.y + radius, grid.y - 1); ++y) {
      for (int x = std::max(t.x - radius, 0); x <= std::min(t.x + radius, grid.x - 1); ++x) {
        const glm::ivec2 q(x, y);
        const double perLight = tiles[q].pixels / lights[q];
        product[t] += perLight * perLight * tiles[q].product;
        square[t] += perLight * perLight * tiles[q].square;
        pixels += tiles[q].pixels;
      }
    }
    product[t] /= pixels;
    square[t] /= pixels;
  });
  Image<double> shares(kSize);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec2 at = (glm::dvec2(p) + 0.5 + double(kBefore)) / double(kTile) - 0.5;
    const glm::dvec2 base = glm::floor(at), f = at - base;
    const auto bilinear = [&](const Image<double>& image) {
      const auto texel = [&](int x, int y) {
        return image[glm::clamp(glm::ivec2(base) + glm::ivec2(x, y), glm::ivec2(0), grid - 1)];
      };
      return (1.0 - f.y) * ((1.0 - f.x) * texel(0, 0) + f.x * texel(1, 0)) +
             f.y * ((1.0 - f.x) * texel(0, 1) + f.x * texel(1, 1));
    };
    const double least = settings.residualLeastShare;
    shares[p] = std::clamp((bilinear(product) / bilinear(square) - least) / (1.0 - least), 0.0, 1.0);
  });
  return shares;
}

double rmsError(const Image<glm::dvec4>& image, const Image<glm::dvec4>& truth) {
  double squares = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { squares += std::pow(image[p].g - truth[p].g, 2.0); });
  return std::sqrt(squares / (kSize.x * kSize.y));
}

class AccumulatedShare : public fg::test::GpuTest {};

TEST_F(AccumulatedShare, AgreesWithDoublePrecision) {
  const Light light = stripedLight(0.5, 1.0);
  const Image<glm::dvec4> predicted = FilterOfWall(device(), false).filter(light);
  const Image<double> shares = sharesOf(light, predicted, {});
  FilterOfWall filter(device(), true);
  // The first frame has no statistics.
  const Image<glm::dvec4> first = filter.filter(light);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { EXPECT_EQ(first[p], predicted[p]); });
  for (int frame = 1; frame < 4; ++frame) {
    const Image<glm::dvec4> actual = filter.filter(light);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const double x = predicted[p].g, m = light.mean[p].g;
      // The prediction and the result are rounded to halves. The statistics are of predictions that are not, so that
      // residuals differ by 2^-11 of the light, and means of their squares, whose roots are above half of the light, by
      // less than 2^-9; the share is a ratio of two such means over 1 - least share.
      const double tolerance = 2.0 * std::exp2(-11.0) * std::max(x, m) + std::exp2(-7.0) * std::abs(m - x);
      EXPECT_NEAR(actual[p].g, x + shares[p] * (m - x), tolerance) << p.x << ", " << p.y << ", frame " << frame;
    });
  }
}

TEST_F(AccumulatedShare, IsWholeWhereNothingIsNoise) {
  const Light light = stripedLight(0.5, 0.0);
  FilterOfWall filter(device(), true);
  static_cast<void>(filter.filter(light));
  const Image<glm::dvec4> result = filter.filter(light);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    // The half of the history is (8 m - y) / 7, so that the rounding of m to halves counts 8/7 times.
    EXPECT_NEAR(result[p].g, light.truth[p].g, 4.0 * std::exp2(-11.0) * light.truth[p].g) << p.x << ", " << p.y;
  });
}

TEST_F(AccumulatedShare, ErrsLessThanPredictionAndMeanWhereBothErr) {
  const Light light = stripedLight(0.3, 1.0);
  FilterOfWall filter(device(), true);
  const double predicted = rmsError(filter.filter(light), light.truth);
  const double mixed = rmsError(filter.filter(light), light.truth);
  const double mean = rmsError(light.mean, light.truth);
  // With variances .09 of what fits miss and 1/8 of noise the best mixture errs by the root of .09 x .125 / .215 =
  // .229, and the prediction by .3. A quarter of this gain is left to the statistics of some thousand pixels.
  EXPECT_LT(mixed, predicted - 0.75 * (0.3 - 0.229));
  EXPECT_LT(mixed, mean);
}

TEST_F(AccumulatedShare, IsNothingWhereOnlyNoiseIsLeft) {
  for (const double noise : {0.5, 3.0}) {
    const Light light = stripedLight(0.0, noise);
    FilterOfWall filter(device(), true);
    const double predicted = rmsError(filter.filter(light), light.truth);
    const double mixed = rmsError(filter.filter(light), light.truth);
    // Statistics of one frame over 40 x 40 pixels err by 1 / 40 of the square of the noise, times some 3 for the
    // product of two halves of unlike length. So a share of .05 is exceeded by .03 here and there, and .03 of the
    // mean's noise is added.
    EXPECT_LT(mixed, predicted + 0.03 * noise / std::sqrt(kSamples)) << noise;
  }
}

TEST_F(AccumulatedShare, StaysFiniteWithBrokenAndExtremeLight) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {0.0, 6e-8, 30000.0}) {
    Light light = stripedLight(0.5, 1.0);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      for (int c = 0; c < 3; ++c) {
        light.lighting[p][c] = p.x % 7 == 3 ? kNan : std::min(scale * light.lighting[p][c], 65504.0);
        light.mean[p][c] = std::min(scale * light.mean[p][c], 65504.0);
      }
      if (p.y % 5 == 2) light.mean[p].a = 0.0;
    });
    FilterOfWall filter(device(), true);
    for (int frame = 0; frame < 3; ++frame) {
      const Image<glm::dvec4> result = filter.filter(light);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(result[p][c]) && result[p][c] >= 0.0) << scale;
      });
    }
  }
}

}  // namespace
}  // namespace walr::test
