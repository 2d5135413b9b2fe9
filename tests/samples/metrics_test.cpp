#include "samples/metrics/metrics.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samples/image/tone_map.h"
#include "tests/samples/metric_pictures.h"

namespace walr {
namespace {

using test::makePictures;
using test::Pictures;

PixelMask fullMask(const Image& image) {
  return PixelMask(image.pixelCount(), 1);
}

TEST(Metrics, AgreeWithScikitImage) {
  std::ifstream stream(WALR_TEST_DATA "/metric_fixture.json");
  const auto cases = nlohmann::json::parse(stream);
  ASSERT_FALSE(cases.empty());
  for (const auto& expected : cases) {
    SCOPED_TRACE(expected["name"].get<std::string>());
    const int width = expected["width"];
    const int stride = expected["masked_stride"];
    const Pictures pictures = makePictures(width, expected["height"], expected["amplitude"]);
    PixelMask mask = fullMask(pictures.reference);
    for (int i = 0; stride > 0 && i < static_cast<int>(mask.size()); ++i) {
      mask[static_cast<std::size_t>(i)] = (i % width + 2 * (i / width)) % stride != 0 ? 1 : 0;
    }
    const ErrorFigures figures = compare(pictures.test, pictures.reference, mask);
    // Both sides compute the tone map in float, so that pixels differ by at most the unit roundoff. A mean does not
    // enlarge that. SSIM divides it by C2 = 9e-4; PSNR multiplies the relative error by 20 / ln 10.
    const double roundoff = std::numeric_limits<float>::epsilon();
    EXPECT_NEAR(*figures.rmse, expected["rmse"].get<double>(), roundoff);
    EXPECT_NEAR(*figures.psnr, expected["psnr"].get<double>(), 8.7 * roundoff / expected["rmse"].get<double>());
    EXPECT_NEAR(*figures.ssim, expected["ssim"].get<double>(), roundoff / 9e-4);
  }
}

TEST(Metrics, EqualImagesHaveNoErrorAndNoPsnr) {
  const Pictures pictures = makePictures(20, 16, 0.0);
  const ErrorFigures figures = compare(pictures.reference, pictures.reference, fullMask(pictures.reference));
  EXPECT_EQ(figures.rmse, 0.0);
  EXPECT_FALSE(figures.psnr.has_value());
  // Not exactly 1: numerator and denominator differ by a few rounding errors of double.
  EXPECT_NEAR(*figures.ssim, 1.0, 1e-12);
}

TEST(Metrics, AnEmptyMaskHasNoFigures) {
  const Pictures pictures = makePictures(20, 16, 1.0);
  const ErrorFigures figures =
      compare(pictures.test, pictures.reference, PixelMask(pictures.reference.pixelCount(), 0));
  EXPECT_FALSE(figures.rmse || figures.psnr || figures.ssim);
}

TEST(Metrics, TooSmallForAWindowHasNoSsim) {
  const Pictures pictures = makePictures(10, 30, 1.0);
  const ErrorFigures figures = compare(pictures.test, pictures.reference, fullMask(pictures.reference));
  EXPECT_GT(*figures.rmse, 0.0);
  EXPECT_FALSE(figures.ssim.has_value());
}

TEST(Metrics, NonFiniteTestValuesCountAsTheWorst) {
  Image reference(1, 2, 3);
  Image test(1, 2, 3);
  for (int c = 0; c < 3; ++c) {
    reference.at(0, 0, c) = 0.25F;  // Tone-mapped 0.2: the worst value is 1, an error of 0.8.
    reference.at(0, 1, c) = 4.0F;   // Tone-mapped 0.8: the worst value is 0, an error of 0.8.
    test.at(0, 0, c) = std::numeric_limits<float>::quiet_NaN();
    test.at(0, 1, c) = std::numeric_limits<float>::infinity();
  }
  EXPECT_NEAR(*compare(test, reference, fullMask(reference)).rmse, 0.8, 1e-7);
  EXPECT_EQ(countNonFinite(test), 6U);
}

TEST(Metrics, RelativeMseFollowsItsDefinition) {
  Image reference(2, 1, 3);
  Image test(2, 1, 3);
  for (int c = 0; c < 3; ++c) {
    reference.at(0, 0, c) = 2.0F;
    test.at(0, 0, c) = 2.5F;  // 0.25 / 4.01
    test.at(1, 0, c) = 0.5F;  // Reference 0: 0.25 / 0.01
  }
  EXPECT_NEAR(*relativeMse(test, reference, {1, 1}), 0.5 * (0.25 / 4.01 + 25.0), 1e-12);
  EXPECT_NEAR(*relativeMse(test, reference, {1, 0}), 0.25 / 4.01, 1e-12);
  EXPECT_EQ(relativeMse(reference, reference, {1, 1}), 0.0);
  EXPECT_FALSE(relativeMse(test, reference, {0, 0}).has_value());
  for (int c = 0; c < 3; ++c) test.at(1, 0, c) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(*relativeMse(test, reference, {0, 1}), 65504.0 * 65504.0 / 0.01, 1.0);
}

TEST(Metrics, NoiseOfAReferenceIsThatOfTheMeanOfItsHalves) {
  // Two halves with uniform noise of known standard deviation, far below 1, where the tone map is nearly the identity.
  constexpr int kSize = 256;
  constexpr double kAmplitude = 1e-4;
  Image reference(kSize, kSize, 3);
  Image half(kSize, kSize, 3);
  for (std::uint32_t i = 0; i < kSize * kSize * 3; ++i) {
    const double a = 0.001 + kAmplitude * (test::uniform(2 * i) - 0.5);
    const double b = 0.001 + kAmplitude * (test::uniform(2 * i + 1) - 0.5);
    half.values()[i] = static_cast<float>(a);
    reference.values()[i] = static_cast<float>(0.5 * (a + b));
  }
  // The mean of two values has 1 / sqrt(2) of the standard deviation of one. The relative error of its estimate from n
  // values is at most 1 / sqrt(n); the tolerance is five times that. The slope of the tone map lies within 0.3 % of 1.
  const double expected = kAmplitude / std::sqrt(12.0) / std::sqrt(2.0);
  const double spread = 5.0 / std::sqrt(kSize * kSize * 3.0);
  EXPECT_NEAR(*referenceNoise(reference, half, fullMask(reference)), expected, (spread + 0.003) * expected);
  EXPECT_FALSE(referenceNoise(reference, half, PixelMask(reference.pixelCount(), 0)).has_value());
}

TEST(Metrics, ACleanSquareIsThatOfTheErrorAlone) {
  // Rare light: of 4 samples a half, each finds light 40 with a chance of 1/20. The tone map bends over such noise.
  constexpr std::uint32_t kSize = 256;
  constexpr float kValue = 0.4F;
  Image test(kSize, kSize, 3), reference(kSize, kSize, 3), half(kSize, kSize, 3);
  double meanOfHalves = 0.0;
  for (std::uint32_t i = 0; i < kSize * kSize * 3; ++i) {
    float found[2] = {0.0F, 0.0F};
    for (std::uint32_t k = 0; k < 8; ++k) found[k / 4] += test::uniform(8 * i + k) < 0.05 ? 10.0F : 0.0F;
    test.values()[i] = kValue;
    half.values()[i] = found[0];
    reference.values()[i] = 0.5F * (found[0] + found[1]);
    meanOfHalves += 0.5 * (toneMap(found[0]) + toneMap(found[1]));
  }
  meanOfHalves /= kSize * kSize * 3.0;
  // Halves are independent, so that the product's mean is the square of the mean error. Tone-mapped values lie within 0
  // and 1, and so do products of errors: five standard errors of the mean of n of them are at most 5 / (2 sqrt(n)).
  const double expected = (kValue - meanOfHalves) * (kValue - meanOfHalves);
  const double tolerance = 2.5 / std::sqrt(kSize * kSize * 3.0);
  const PixelMask all = fullMask(reference);
  EXPECT_NEAR(cleanSquare(test, reference, half, all).value(), expected, tolerance);
  // The square less that of the estimated noise is not.
  Image shown = reference;
  for (float& value : shown.values()) value = toneMap(value);
  const double square = std::pow(rmseOf({test, shown}, all).value(), 2.0);
  EXPECT_GT(std::abs(square - std::pow(referenceNoise(reference, half, all).value(), 2.0) - expected), 2.0 * tolerance);
  EXPECT_FALSE(cleanSquare(test, reference, half, PixelMask(reference.pixelCount(), 0)).has_value());
}

TEST(Metrics, MaskedOutPixelsDoNotCount) {
  Pictures pictures = makePictures(24, 24, 0.2);
  PixelMask mask = fullMask(pictures.reference);
  mask[5 * 24 + 7] = 0;
  const ErrorFigures before = compare(pictures.test, pictures.reference, mask);
  pictures.test.at(7, 5, 1) = std::numeric_limits<float>::quiet_NaN();
  const ErrorFigures after = compare(pictures.test, pictures.reference, mask);
  EXPECT_EQ(before.rmse, after.rmse);
  EXPECT_EQ(before.ssim, after.ssim);
}

TEST(Metrics, MaskHoldsDiffuseSurfacesWithAKnownReference) {
  Image albedo(5, 1, 3);
  Image normal(5, 1, 3);
  Image depth(5, 1, 1);
  Image reference(5, 1, 3);
  for (int x = 0; x < 5; ++x) {
    albedo.at(x, 0, 2) = 0.01F;
    normal.at(x, 0, 1) = 1.0F;
    depth.at(x, 0, 0) = 2.0F;
  }
  albedo.at(1, 0, 2) = 0.009F;
  normal.at(2, 0, 1) = 0.0F;
  depth.at(3, 0, 0) = 1e10F;
  reference.at(4, 0, 0) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(diffuseMask(albedo, normal, depth, 1e9F, reference), (PixelMask{1, 0, 0, 0, 0}));
}

TEST(Metrics, MeansLeaveOutFramesWithoutAValue) {
  MeanFigures mean;
  mean.add({0.25, 12.0, 0.5});
  mean.add({0.75, std::nullopt, std::nullopt});
  EXPECT_EQ(mean.mean().rmse, 0.5);
  EXPECT_EQ(mean.mean().psnr, 12.0);
  EXPECT_EQ(mean.mean().ssim, 0.5);
  EXPECT_FALSE(MeanFigures().mean().rmse.has_value());
}

}  // namespace
}  // namespace walr
