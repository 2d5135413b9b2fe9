#include "samples/metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace walr {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;
constexpr std::size_t kPixels = static_cast<std::size_t>(kWidth) * kHeight;

/// A wall four units away that moves by the given number of pixels from frame to frame.
VisibleSurfaces wall(float motionX, float motionY) {
  VisibleSurfaces surfaces{Image(kWidth, kHeight, 1), Image(kWidth, kHeight, 3), Image(kWidth, kHeight, 3),
                           PixelMask(kPixels, 1)};
  for (std::size_t i = 0; i < kPixels; ++i) {
    surfaces.depth.pixel(i)[0] = 4.0F;
    surfaces.normal.pixel(i)[2] = 1.0F;
    surfaces.motion.pixel(i)[0] = motionX;
    surfaces.motion.pixel(i)[1] = motionY;
  }
  return surfaces;
}

/// A grey pattern that moves with the wall: the reference without noise, the test image with white noise.
DisplayedPair noisyPattern(int shift, double deviation, std::mt19937& random) {
  DisplayedPair pair{Image(kWidth, kHeight, 3), Image(kWidth, kHeight, 3)};
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double pattern = 0.5 + 0.2 * std::sin(0.7 * (x - shift)) * std::cos(0.4 * y);
      const double test = pattern + 0.1 + deviation * noise(random);
      for (int c = 0; c < 3; ++c) {
        pair.reference.at(x, y, c) = static_cast<float>(pattern);
        pair.test.at(x, y, c) = static_cast<float>(test);
      }
    }
  }
  return pair;
}

TEST(Flicker, OfWhiteNoiseIsItsDeviation) {
  std::mt19937 random(1);
  constexpr double kDeviation = 0.05;
  const DisplayedPair previous = noisyPattern(0, kDeviation, random);
  const DisplayedPair current = noisyPattern(3, kDeviation, random);
  const auto pixels = previousPixels(wall(-3.0F, 0.0F), wall(-3.0F, 0.0F));
  // The root mean square of n normal values has the standard deviation s / sqrt(2 n). Every value enters two
  // differences, which increases it by at most sqrt(2). The tolerance is five times that.
  EXPECT_NEAR(*flicker(errorChange(current, previous, pixels)), kDeviation, 5.0 * kDeviation / std::sqrt(kPixels));
}

TEST(Flicker, AnErrorThatStaysWithItsSurfaceDoesNotFlicker) {
  std::mt19937 random(1);
  const DisplayedPair previous = noisyPattern(0, 0.0, random);
  const DisplayedPair current = noisyPattern(3, 0.0, random);
  const auto pixels = previousPixels(wall(-3.0F, 0.0F), wall(-3.0F, 0.0F));
  // The constant error of 0.1 cancels except for the rounding errors of floats below 1.
  EXPECT_NEAR(*flicker(errorChange(current, previous, pixels)), 0.0, std::numeric_limits<float>::epsilon());
}

TEST(Flicker, WithoutPreviousPixelsHasNoValue) {
  std::mt19937 random(1);
  const DisplayedPair pair = noisyPattern(0, 0.1, random);
  EXPECT_FALSE(flicker(errorChange(pair, pair, std::vector<std::uint32_t>(kPixels, kNoPixel))).has_value());
}

TEST(PreviousPixels, AreTheNearestPixelsAlongMotion) {
  const VisibleSurfaces surfaces = wall(-2.4F, 1.6F);
  const auto pixels = previousPixels(surfaces, surfaces);
  EXPECT_EQ(pixels[10 * kWidth + 20], 12U * kWidth + 18U);
  EXPECT_EQ(pixels[10 * kWidth + 1], kNoPixel) << "left of the image";
  EXPECT_EQ(pixels[(kHeight - 1) * kWidth + 20], kNoPixel) << "below the image";
}

TEST(PreviousPixels, AreMissingAtDisocclusions) {
  VisibleSurfaces current = wall(0.0F, 0.0F);
  VisibleSurfaces previous = wall(0.0F, 0.0F);
  previous.depth.pixel(0)[0] = 4.2F;  // The depth differs by 5 %.
  previous.depth.pixel(1)[0] = 4.2F;  // The same, but the motion predicts this depth.
  current.motion.pixel(1)[2] = 0.2F;
  previous.normal.pixel(2)[0] = 0.6F;  // The normal differs by 37 degrees.
  previous.normal.pixel(2)[2] = 0.8F;
  previous.mask[3] = 0;
  current.mask[4] = 0;
  current.motion.pixel(5)[0] = std::numeric_limits<float>::quiet_NaN();
  const auto pixels = previousPixels(current, previous);
  const std::vector<std::uint32_t> first(pixels.begin(), pixels.begin() + 7);
  EXPECT_EQ(first, (std::vector<std::uint32_t>{kNoPixel, 1, kNoPixel, kNoPixel, kNoPixel, kNoPixel, 6}));
  EXPECT_NEAR(*disoccludedShare(pixels, current.mask), 4.0 / (kPixels - 1.0), 1e-12);
}

TEST(LuminanceChangeTest, OfWhiteNoiseIsItsMeanDifference) {
  std::mt19937 random(2);
  constexpr double kDeviation = 0.05;
  const DisplayedPair previous = noisyPattern(0, kDeviation, random);
  const DisplayedPair current = noisyPattern(0, kDeviation, random);
  const auto change = luminanceChange(current, previous, PixelMask(kPixels, 1), PixelMask(kPixels, 1));
  // The absolute difference of two normal values has the mean 2 s / sqrt(pi) and a smaller standard deviation.
  const double expected = 2.0 * kDeviation / std::sqrt(3.14159265358979);
  EXPECT_NEAR(change->test, expected, 5.0 * expected / std::sqrt(kPixels));
  EXPECT_EQ(change->reference, 0.0);
}

TEST(LuminanceChangeTest, CountsPixelsOfBothFrames) {
  DisplayedPair previous{Image(2, 1, 3), Image(2, 1, 3)};
  DisplayedPair current = previous;
  for (int c = 0; c < 3; ++c) {
    current.test.at(0, 0, c) = 0.5F;
    current.reference.at(0, 0, c) = 0.25F;
    current.test.at(1, 0, c) = 1.0F;
  }
  const auto change = luminanceChange(current, previous, {1, 1}, {1, 0});
  EXPECT_NEAR(change->test, 0.5, 1e-12);
  EXPECT_NEAR(change->reference, 0.25, 1e-12);
  EXPECT_FALSE(luminanceChange(current, previous, {1, 0}, {0, 1}).has_value());
}

}  // namespace
}  // namespace walr
