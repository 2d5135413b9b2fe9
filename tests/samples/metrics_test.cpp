#include "samples/metrics/metrics.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace walr {
namespace {

/// The hash of make_metric_fixture.py.
double uniform(std::uint32_t n) {
  n ^= n >> 16U;
  n *= 0x7FEB352DU;
  n ^= n >> 15U;
  n *= 0x846CA68BU;
  n ^= n >> 16U;
  return n / 4294967296.0;
}

struct Pictures {
  Image test;
  Image reference;
};

/// The pictures of make_metric_fixture.py.
Pictures makePictures(int width, int height, double amplitude) {
  Pictures pictures{Image(width, height, 3), Image(width, height, 3)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double reference = 0.1 + 0.15 * ((3 * x + 5 * y + 7 * c) % 17) + 0.02 * x;
        const auto index = static_cast<std::uint32_t>((y * width + x) * 3 + c);
        pictures.reference.at(x, y, c) = static_cast<float>(reference);
        pictures.test.at(x, y, c) = static_cast<float>(reference * (1.0 + amplitude * (uniform(index) - 0.5)));
      }
    }
  }
  return pictures;
}

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
    // The tone map is computed in float on both sides: its unit roundoff bounds the difference of each pixel, which a
    // mean does not enlarge; SSIM divides by C2 = 9e-4, and PSNR multiplies the relative error by 20 / ln 10.
    const double roundoff = std::numeric_limits<float>::epsilon();
    EXPECT_NEAR(*figures.rmse, expected["rmse"].get<double>(), roundoff);
    EXPECT_NEAR(*figures.psnr, expected["psnr"].get<double>(), 8.7 * roundoff / expected["rmse"].get<double>());
    EXPECT_NEAR(*figures.ssim, expected["ssim"].get<double>(), roundoff / 9e-4);
  }
}

TEST(Metrics, EqualPicturesHaveNoErrorAndNoPsnr) {
  const Pictures pictures = makePictures(20, 16, 0.0);
  const ErrorFigures figures = compare(pictures.reference, pictures.reference, fullMask(pictures.reference));
  EXPECT_EQ(figures.rmse, 0.0);
  EXPECT_FALSE(figures.psnr.has_value());
  // Not exactly 1 by rounding: numerator and denominator are equal up to a few roundings of double.
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
    reference.at(0, 0, c) = 0.25F;  // Tone-mapped 0.2: the worst is 1, off by 0.8.
    reference.at(0, 1, c) = 4.0F;   // Tone-mapped 0.8: the worst is 0, off by 0.8.
    test.at(0, 0, c) = std::numeric_limits<float>::quiet_NaN();
    test.at(0, 1, c) = std::numeric_limits<float>::infinity();
  }
  EXPECT_NEAR(*compare(test, reference, fullMask(reference)).rmse, 0.8, 1e-7);
  EXPECT_EQ(countNonFinite(test), 6U);
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

TEST(Metrics, MeansLeaveOutFramesWithoutAFigure) {
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
