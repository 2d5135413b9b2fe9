// The share of accumulated light in the result (passes/WALR.md, 9): against a calculation in double
// precision, and by what it is for.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "tests/passes/expected_share.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::accumulated_share_test {
namespace {

class AccumulatedShare : public fg::test::GpuTest {
 protected:
  /// @param partly whether tiles are to be trusted in part
  void expectAgreement(const ResidualLight& light, const Scene& scene, bool hasEdges, bool partly) const {
    const Image<glm::dvec4> predicted = FilterOf(device(), scene, false).filter(light);
    FilterOf filter(device(), scene, true);
    const ExpectedResult expected(filter, light, predicted);
    EXPECT_TRUE(expected.trustsInPart() || !partly);
    MeasuredFrames measured;
    measured.add(expected, 0);
    // The first frame has no statistics.
    const Image<glm::dvec4> first = filter.filter(light);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { EXPECT_EQ(first[p], predicted[p]); });
    for (int frame = 1; frame < 4; ++frame) {
      const Image<glm::dvec4> actual = filter.filter(light);
      bool edges = false;
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        edges = edges || expected.besideEdge(p);
        const auto [around, detail] = measured.takesPart(tileOf(p), 0)
                                          ? expected.added(p, measured.statistics(), kSamples)
                                          : std::array{0.0, 0.0};
        const double x = predicted[p].g;
        const double tolerance =
            toleranceOf(std::max(x, light.mean[p].g), expected.residuals(p), expected.trustsInPart());
        EXPECT_NEAR(actual[p].g, std::max(x + around + detail, 0.0), tolerance)
            << p.x << ", " << p.y << ", frame " << frame;
      });
      EXPECT_EQ(edges, hasEdges);
      measured.add(expected, 0);
    }
  }
};

TEST_F(AccumulatedShare, AgreesWithDoublePrecision) {
  const ResidualLight light = stripedLight(0.5, 1.0);
  for (const auto& [scene, hasEdges] : {std::pair{flatWall(), false}, std::pair{thinBars(), true}}) {
    expectAgreement(light, scene, hasEdges, false);
    expectAgreement(withSharedNoise(light), scene, hasEdges, true);
  }
}

// Light that comes to have detail while its tiles are quiet. Few of them measure it in each frame, until all wake.
TEST_F(AccumulatedShare, QuietTilesTakePartInTurn) {
  const ResidualLight unrelated = unrelatedLight(), stripes = stripedLight(0.17, 0.5);
  FilterOf fits(device(), flatWall(), false), filter(device(), flatWall(), true);
  MeasuredFrames measured;
  int quietFrames = 0, awakeFrames = 0;
  for (std::uint32_t i = 0; i < 10; ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    const ResidualLight& light = i < 2 ? unrelated : stripes;
    const Image<glm::dvec4> predicted = fits.filter(light, i), actual = filter.filter(light, i);
    const ExpectedResult expected(fits, light, predicted);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const double x = predicted[p].g;
      if (!measured.takesPart(tileOf(p), i)) {
        EXPECT_EQ(actual[p].g, x) << p.x << ", " << p.y;
        return;
      }
      const auto [around, detail] = expected.added(p, measured.statistics(), kSamples);
      EXPECT_NEAR(actual[p].g, std::max(x + around + detail, 0.0),
                  toleranceOf(std::max(x, light.mean[p].g), expected.residuals(p), false))
          << p.x << ", " << p.y;
    });
    measured.add(expected, i);
    quietFrames += measured.quietTiles() == kTiles.x * kTiles.y ? 1 : 0;
    awakeFrames += measured.quietTiles() == 0 ? 1 : 0;
  }
  EXPECT_GT(quietFrames, 2);
  EXPECT_GT(awakeFrames, 2);
}

TEST_F(AccumulatedShare, ShortensTheHistoryOfAntialiasing) {
  const auto add = [](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
    BlockLight light{.accumulated = inputs[0], .alpha = LightingAlpha::SampleCount, .lighting = inputs[1]};
    light.history = declareSteeredHistory(graph, graph.textureDesc(inputs[0]).extent, float(kSamples));
    static_cast<void>(
        addBlockFilter(graph, frame, light, guides, {.size = kBlock, .iterations = 2, .coarseSigma = 0.15F}));
    fg::Texture limits = light.history->limits.current;
    ++limits.version;  // That which the filter writes.
    return limits;
  };
  const glm::ivec2 tiles = (kSize - 1) / kAntilagTile + 1;
  bool between = false;
  // S, the square of the stripes, counts eightfold against the noise of the mean, 1/8: shares of .59, .72 and .94.
  for (const double stripes : {0.15, 0.2, 0.5}) {
    for (const Scene& scene : {flatWall(), thinBars()}) {
      SCOPED_TRACE(stripes);
      const ResidualLight light = stripedLight(stripes, 1.0);
      FilterOf fits(device(), scene, false);
      const ExpectedResult expected(fits, light, fits.filter(light));
      const reference::HostFrame frame = renderStill(scene, kSize);
      FilterRun run(device(), kSize, 2, add, true);
      for (int i = 0; i < 3; ++i) {
        const Image<glm::dvec4> actual = run.run(frame, fits.guides(), {light.mean, light.lighting});
        reference::forEachPixel(tiles, [&](glm::ivec2 t) {
          const auto [shortening, tolerance] = expected.shortening(t);
          between = between || (shortening > 0.1 && shortening < 0.9);
          EXPECT_NEAR(actual[t].y, i == 0 ? 0.0 : shortening, tolerance) << t.x << ", " << t.y << ", frame " << i;
        });
      }
    }
  }
  EXPECT_TRUE(between);
}

// A pixel whose surface has just appeared has no history that could agree with its light, but statistics of the frame
// before. Its neighbours have just appeared, too, and their mean counts.
TEST_F(AccumulatedShare, TakesMeansOfPixelsWithoutHistory) {
  const ResidualLight light = stripedLight(0.5, 1.0);
  ResidualLight appearing = light;
  constexpr int kAppearing = 27;  // Columns of pixels.
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (p.x < kAppearing) appearing.mean[p].a = 1.0;
  });
  FilterOf fits(device(), flatWall(), false);
  const ExpectedResult before(fits, light, fits.filter(light));
  const Image<glm::dvec4> predicted = fits.filter(appearing);
  const ExpectedResult now(fits, appearing, predicted);
  FilterOf filter(device(), flatWall(), true);
  static_cast<void>(filter.filter(light));
  const Image<glm::dvec4> actual = filter.filter(appearing);
  double added = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (p.x >= kAppearing - 1) return;  // Here, all of the 3 x 3 pixels have just appeared.
    const auto [around, detail] = now.added(p, before.statistics(), 1.0);
    added = std::max(added, std::abs(around));
    const double x = predicted[p].g;
    const double tolerance = toleranceOf(std::max(x, appearing.mean[p].g), now.residuals(p), false);
    EXPECT_NEAR(actual[p].g, std::max(x + around + detail, 0.0), tolerance) << p.x << ", " << p.y;
  });
  EXPECT_GT(added, 0.05);
}

TEST_F(AccumulatedShare, IsWholeWhereNothingIsNoise) {
  const ResidualLight light = stripedLight(0.5, 0.0);
  FilterOf filter(device(), flatWall(), true);
  const Image<glm::dvec4> result = filter.settled(light);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    // The half of the history is (8 m - y) / 7, so that the rounding of m to halves counts 8/7 times.
    EXPECT_NEAR(result[p].g, light.truth[p].g, 4.0 * std::exp2(-11.0) * light.truth[p].g) << p.x << ", " << p.y;
  });
}

TEST_F(AccumulatedShare, ErrsLessThanPredictionAndMeanWhereBothErr) {
  const ResidualLight light = stripedLight(0.3, 1.0);
  FilterOf filter(device(), flatWall(), true);
  const double predicted = rmsError(filter.filter(light), light.truth);
  const double mixed = rmsError(filter.filter(light), light.truth);
  const double mean = rmsError(light.mean, light.truth);
  // With variances .09 of what fits miss and 1/8 of noise the share is 8 x .09 / (8 x .09 + .125) = .85, less what the
  // least share takes off it: .63. The mixture then errs by the root of .37^2 x .09 + .63^2 x .125 = .249, and the
  // prediction by .3. A quarter of this gain is left to the statistics of some thousand pixels. (The best share is .42,
  // for .229. The setting blocks.residual-gain takes history for blurred, which it is not here.)
  EXPECT_LT(mixed, predicted - 0.75 * (0.3 - 0.249));
  EXPECT_LT(mixed, mean);
}

TEST_F(AccumulatedShare, IsNothingWhereOnlyNoiseIsLeft) {
  for (const double noise : {0.5, 3.0}) {
    const ResidualLight light = stripedLight(0.0, noise);
    FilterOf filter(device(), flatWall(), true);
    const double predicted = rmsError(filter.filter(light), light.truth);
    const double mixed = rmsError(filter.filter(light), light.truth);
    // The statistics are means over 40 x 40 pixels of one frame: they err by 1 / 40 of the squared noise, times about
    // 3, because the two halves differ in their number of samples. Where they take .1 of the squared noise for missed
    // light, it counts eightfold, which makes a share of .8 / 1.8 = .44, below the least share of .6.
    EXPECT_EQ(mixed, predicted) << noise;
  }
}

// As resampled light has it (ReSTIR): light and history have the same noise, which differs from pixel to pixel.
TEST_F(AccumulatedShare, IsNothingWhereLightAndHistoryShareTheirNoise) {
  ResidualLight light = stripedLight(0.0, 1.0);
  light.mean = light.lighting;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { light.mean[p].a = kSamples; });
  FilterOf filter(device(), flatWall(), true);
  const Image<glm::dvec4> predicted = filter.filter(light);
  const Image<glm::dvec4> mixed = filter.filter(light);
  // A ninth of the noise is in the means around a pixel, and a quarter where a tile's corner has four pixels only: .17
  // on average over a tile. Products two pixels apart err by 1 / 40 over 40 x 40 pixels: at most .3 is less than the
  // .75 up to which nothing is trusted.
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { EXPECT_EQ(mixed[p], predicted[p]) << p.x << ", " << p.y; });
}

TEST_F(AccumulatedShare, StaysFiniteWithBrokenAndExtremeLight) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double scale : {0.0, 6e-8, 30000.0}) {
    ResidualLight light = stripedLight(0.5, 1.0);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      for (int c = 0; c < 3; ++c) {
        light.lighting[p][c] = p.x % 7 == 3 ? kNan : std::min(scale * light.lighting[p][c], 65504.0);
        light.mean[p][c] = std::min(scale * light.mean[p][c], 65504.0);
      }
      if (p.y % 5 == 2) light.mean[p].a = 0.0;
    });
    FilterOf filter(device(), flatWall(), true);
    for (int frame = 0; frame < 3; ++frame) {
      const Image<glm::dvec4> result = filter.filter(light);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(result[p][c]) && result[p][c] >= 0.0) << scale;
      });
    }
  }
}

}  // namespace
}  // namespace walr::test::accumulated_share_test
