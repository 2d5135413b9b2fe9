#include "samples/metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/samples/metric_pictures.h"

namespace walr {
namespace {

Image constant(int width, int height, float r, float g, float b) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) std::ranges::copy(std::array{r, g, b}, image.pixel(i).begin());
  return image;
}

DisplayedPair displayAll(const test::Pictures& pictures) {
  return display(pictures.test, pictures.reference, PixelMask(pictures.reference.pixelCount(), 1));
}

std::vector<double> wholeMap(const DisplayedPair& pair, double pixelsPerDegree = kFlipPixelsPerDegree) {
  return flipMap(pair, PixelMask(pair.reference.pixelCount(), 1), pixelsPerDegree);
}

TEST(Flip, AgreesWithItsAuthorsImplementation) {
  std::ifstream stream(WALR_TEST_DATA "/flip_fixture.json");
  const auto cases = nlohmann::json::parse(stream);
  ASSERT_FALSE(cases.empty());
  // The authors' implementation uses single precision. An error e of a feature difference d changes its square root by
  // e / (2 sqrt(d)). The differences here are above 1e-3; e is about sixty rounding errors of values below 1.
  const double tolerance = 60.0 * std::numeric_limits<float>::epsilon() / (2.0 * std::sqrt(1e-3));
  for (const auto& expected : cases) {
    SCOPED_TRACE(expected["name"].get<std::string>());
    const DisplayedPair pair =
        displayAll(test::makePictures(expected["width"], expected["height"], expected["amplitude"]));
    const std::vector<double> map = wholeMap(pair, expected["pixels_per_degree"]);
    EXPECT_NEAR(*maskedMean(map, PixelMask(map.size(), 1)), expected["mean"].get<double>(), tolerance);
    const std::size_t stride = expected["stride"];
    for (std::size_t i = 0; i < map.size(); i += stride) {
      EXPECT_NEAR(map[i], expected["values"][i / stride].get<double>(), tolerance) << "pixel " << i;
    }
  }
}

TEST(Flip, EqualPicturesDifferNowhere) {
  const test::Pictures pictures = test::makePictures(40, 30, 1.0);
  const std::vector<double> map = wholeMap(displayAll({pictures.reference, pictures.reference}));
  EXPECT_EQ(std::ranges::max(map), 0.0);
}

/// Section 4.1.3: the largest colour distance, between green and blue, maps to 1.
TEST(Flip, IsOneBetweenGreenAndBlue) {
  for (const double value : wholeMap({constant(30, 30, 0, 1, 0), constant(30, 30, 0, 0, 1)})) {
    EXPECT_NEAR(value, 1.0, 1e-12);
  }
}

/// The error between black and white has a closed form: they differ only in L*, by 100. The largest distance is that
/// between green and blue, L*a*b* (87.74, -86.18, 83.18) and (32.30, 79.19, -107.86), with the Hunt effect.
TEST(Flip, BetweenBlackAndWhiteFollowsFromTheirLightness) {
  const double greenToBlue = (87.7347 - 32.2970) + std::hypot(0.877347 * -86.1827 - 0.322970 * 79.1875,
                                                              0.877347 * 83.1793 - 0.322970 * -107.8602);
  const double ratio = std::pow(100.0 / greenToBlue, 0.7);
  const double expected = ratio < 0.4 ? 0.95 * ratio / 0.4 : 0.95 + 0.05 * (ratio - 0.4) / 0.6;
  for (const double value : wholeMap({constant(30, 30, 0, 0, 0), constant(30, 30, 1, 1, 1)})) {
    EXPECT_NEAR(value, expected, 1e-4);  // The precision of the primaries above.
  }
}

TEST(Flip, IsSymmetric) {
  const DisplayedPair pair = displayAll(test::makePictures(50, 40, 1.0));
  const std::vector<double> forth = wholeMap(pair);
  const std::vector<double> back = wholeMap({pair.reference, pair.test});
  EXPECT_EQ(forth, back);
}

TEST(Flip, NonFiniteTestValuesGiveErrors) {
  const Image reference = constant(31, 31, 0.5F, 0.5F, 0.5F);
  Image test = reference;
  test.at(15, 15, 0) = std::numeric_limits<float>::quiet_NaN();
  const std::vector<double> map = wholeMap(display(test, reference, PixelMask(31 * 31, 1)));
  EXPECT_GT(map[15 * 31 + 15], 0.1);
  EXPECT_TRUE(std::ranges::all_of(map, [](double value) { return value >= 0.0 && value <= 1.0; }));
}

TEST(Flip, OfSomePixelsIsThatOfAllPixelsThere) {
  const DisplayedPair pair = displayAll(test::makePictures(70, 60, 1.0));
  const std::vector<double> whole = wholeMap(pair);
  // Single pixels at corners and inside, and squares that do and do not touch the border.
  PixelMask wanted(whole.size(), 0);
  const auto want = [&](int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) wanted[static_cast<std::size_t>(y * 70 + x)] = 1;
  };
  want(0, 0, 1, 1);
  want(69, 59, 70, 60);
  want(35, 30, 36, 31);
  want(0, 40, 8, 48);
  want(50, 5, 58, 13);
  const std::vector<double> some = flipMap(pair, wanted);
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(some[i], wanted[i] != 0 ? whole[i] : 0.0) << "pixel " << i;
  EXPECT_GT(std::ranges::max(some), 0.0);
}

TEST(Flip, MeanIsOverTheMask) {
  const std::vector<double> map = {0.25, 1.0, 0.5};
  EXPECT_EQ(maskedMean(map, {1, 0, 1}), 0.375);
  EXPECT_FALSE(maskedMean(map, {0, 0, 0}).has_value());
}

}  // namespace
}  // namespace walr
