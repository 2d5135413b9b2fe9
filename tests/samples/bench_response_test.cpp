#include "samples/bench/response.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "samples/bench/bench_report.h"
#include "samples/bench/response_scene.h"
#include "tests/samples/bench_schema.h"

namespace walr::bench_response_test {
namespace {

constexpr fg::Extent kExtent{96, 54};

TEST(ResponseScene, NoiseHasTheTruthAsItsMean) {
  const KnownFrame frame = lightFrame(kExtent, 3);
  double noisy = 0.0;
  double truth = 0.0;
  double truthSquared = 0.0;
  for (std::size_t i = 0; i < frame.truth.pixelCount(); ++i) {
    noisy += frame.packed.frame.indirect.pixel(i)[0];
    truth += frame.truth.pixel(i)[0];
    truthSquared += std::pow(frame.truth.pixel(i)[0], 2);
  }
  // A sample of mean 1 is 4 (1/2 + u) with a probability of 1/4: its variance is 4 (1 + 1/12) - 1. The tolerance is
  // five standard deviations.
  EXPECT_NEAR(noisy, truth, 5.0 * std::sqrt(truthSquared * (4.0 * 13.0 / 12.0 - 1.0)));
}

TEST(ResponseScene, TheSlabCarriesItsMotionAndUncoversTheWall) {
  const KnownFrame before = slabFrame(kExtent, 10);
  const KnownFrame now = slabFrame(kExtent, 11);
  const std::size_t row = 27 * kExtent.width;
  std::size_t moving = 0;
  for (std::size_t x = 0; x < kExtent.width; ++x) {
    const std::size_t i = row + x;
    if (now.age[i] >= 0) {
      EXPECT_EQ(now.packed.frame.motion.pixel(i)[0], 0.0F);
      EXPECT_EQ(now.age[i] == 0, before.age[i] < 0) << "pixel " << x;
      continue;
    }
    ++moving;
    const auto source = i + static_cast<std::size_t>(static_cast<int>(now.packed.frame.motion.pixel(i)[0]));
    EXPECT_EQ(before.age[source], -1) << "pixel " << x;
  }
  EXPECT_EQ(moving, kExtent.width / 4);
}

/// The age at which a moving Gaussian is nearest to its exponential mean over time. The squared distance is smallest
/// where the product of the two is largest; the product is a sum over ages of products of two Gaussians.
double lagOfExponentialMean(double frames) {
  double best = 0.0;
  double largest = 0.0;
  for (double lag = 0.0; lag < 2.0 * frames; lag += 0.01) {
    double product = 0.0;
    for (int age = 0; age < 200; ++age) {
      const double distance = kLightSpeed * (lag - age) / kLightSigma;
      product += std::pow(1.0 - 1.0 / frames, age) * std::exp(-0.25 * distance * distance);
    }
    if (product > largest) {
      largest = product;
      best = lag;
    }
  }
  return best;
}

TEST(ResponseScene, ACutShowsAnotherPlaceAndSaysSoIfAsked) {
  EXPECT_TRUE(cutFrame(kExtent, kCut, true).packed.frame.resetHistory);
  EXPECT_FALSE(cutFrame(kExtent, kCut, false).packed.frame.resetHistory);
  EXPECT_FALSE(cutFrame(kExtent, kCut + 1, true).packed.frame.resetHistory);
  const KnownFrame before = cutFrame(kExtent, kCut - 1, false);
  const KnownFrame after = cutFrame(kExtent, kCut, false);
  for (std::size_t i = 0; i < after.truth.pixelCount(); ++i) {
    EXPECT_LT(after.truth.pixel(i)[0], 0.5F * before.truth.pixel(i)[0]);
    EXPECT_GT(after.packed.frame.depth.pixel(i)[0], 1.2F * before.packed.frame.depth.pixel(i)[0]);
  }
}

/// Measurements of methods whose response is known.
TEST(ResponseTest, OfMethodsWithAKnownAnswer) {
  GpuDevice device({.device = {}, .validation = true});
  const std::vector<Variant> variants = {parseVariant("none=none"),
                                         parseVariant("mean=accumulate,accumulation.max-history=8"),
                                         parseVariant("alert=accumulate,accumulation.max-history=8,"
                                                      "accumulation.antilag=on")};
  const std::vector<Response> found = responses(device, variants);
  ASSERT_EQ(found.size(), 3U);
  // Without history no old light remains, and every age has the same error. The tolerance is five standard deviations
  // of the mean noise.
  const Response& none = found[0];
  EXPECT_NEAR(none.lightLeft.front(), 0.0, 0.05);
  EXPECT_EQ(none.lightFrames, 0);
  EXPECT_EQ(none.recoveryFrames, 0);
  EXPECT_GT(none.settledFlicker, 0.1);
  // An exponential mean over n frames keeps (1 - 1/n)^k of the light k frames after the change, the first one included:
  // less than a tenth from k = 18 on.
  const Response& mean = found[1];
  for (const int k : {1, 4, 12}) {
    EXPECT_NEAR(mean.lightLeft[static_cast<std::size_t>(k - 1)], std::pow(7.0 / 8.0, k), 0.02) << k;
  }
  EXPECT_NEAR(mean.lightFrames.value(), 17, 1);
  EXPECT_LT(mean.settled, 0.6 * none.settled);
  EXPECT_LT(mean.trailByAge.front(), 0.2) << "the slab is another surface";
  EXPECT_GT(mean.recoveryFrames.value(), 1);
  EXPECT_NEAR(none.lightLag, 0.0, 0.3);
  EXPECT_NEAR(mean.lightLag, lagOfExponentialMean(8.0), 0.3);
  // Nothing of the old image remains: its history is reset, or rejected as another surface. Without history only noise
  // remains.
  for (const Response* response : {&none, &mean}) {
    EXPECT_NEAR(response->cut.left, 0.0, 0.05);
    EXPECT_NEAR(response->untoldCut.left, 0.0, 0.05);
  }
  EXPECT_DOUBLE_EQ(mean.cut.rmse, none.cut.rmse) << "one sample is its own mean";
  // A fall to a tenth sets the antilag factor to 1: the second frame drops history.
  const Response& alert = found[2];
  EXPECT_NEAR(alert.lightLeft[0], 7.0 / 8.0, 0.02);
  EXPECT_NEAR(alert.lightLeft[1], 0.0, 0.05);
  EXPECT_EQ(alert.lightFrames.value(), 1);
  EXPECT_LT(alert.lightLag, 0.6 * mean.lightLag);
  EXPECT_NEAR(alert.settled, mean.settled, 0.05 * mean.settled) << "antilag must not shorten history in constant light";
  EXPECT_TRUE(device.takeMessages().empty());
  BenchReport report;
  report.responses = found;
  EXPECT_EQ(test::schemaTroubles(report), "");
}

}  // namespace
}  // namespace walr::bench_response_test
