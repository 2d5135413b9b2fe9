// Compares texture lookups with values computed by hand.
#include <gtest/gtest.h>

#include <limits>

#include "samples/render/texture.h"

namespace walr::render {
namespace {

// Four texels in a row: 0, 51, 102, 255 in red, with their number in alpha.
Image ramp() {
  Image image;
  image.width = 4;
  image.height = 1;
  image.rgba = {0, 0, 0, 0, 51, 0, 0, 1, 102, 0, 0, 2, 255, 0, 0, 3};
  return image;
}

float red(const Texture& texture, float u, float v = 0.5F) {
  return sampleTexture(ramp(), texture, {u, v}, ColorSpace::Linear).x;
}

// The rounding error of a few operations on values up to 1.
constexpr float kRoundoff = 1e-6F;

TEST(Texture, InterpolatesBetweenTexelCentres) {
  const Texture texture;
  EXPECT_NEAR(red(texture, 0.125F), 0.0F, kRoundoff);
  EXPECT_NEAR(red(texture, 0.375F), 0.2F, kRoundoff);
  EXPECT_NEAR(red(texture, 0.5F), 0.3F, kRoundoff);
  EXPECT_NEAR(red(texture, 0.875F), 1.0F, kRoundoff);
}

TEST(Texture, RepeatBlendsTheLastTexelWithTheFirst) {
  const Texture texture;
  for (const float u : {0.0F, 1.0F, -3.0F}) {
    EXPECT_NEAR(red(texture, u), 0.5F, kRoundoff);
  }
  EXPECT_NEAR(red(texture, -1.625F), 0.2F, kRoundoff);
}

TEST(Texture, ClampRepeatsTheEdgeTexels) {
  Texture texture;
  texture.wrapU = Wrap::ClampToEdge;
  EXPECT_NEAR(red(texture, 0.0F), 0.0F, kRoundoff);
  EXPECT_NEAR(red(texture, -7.0F), 0.0F, kRoundoff);
  EXPECT_NEAR(red(texture, 1.0F), 1.0F, kRoundoff);
  EXPECT_NEAR(red(texture, 9.0F), 1.0F, kRoundoff);
}

TEST(Texture, MirroredRepeatReflectsCoordinates) {
  Texture texture;
  texture.wrapU = Wrap::MirroredRepeat;
  for (const float u : {0.1F, 0.375F, 0.6F, 0.95F}) {
    EXPECT_NEAR(red(texture, 2.0F - u), red(texture, u), kRoundoff);
    EXPECT_NEAR(red(texture, -u), red(texture, u), kRoundoff);
    EXPECT_NEAR(red(texture, 2.0F + u), red(texture, u), kRoundoff);
  }
  EXPECT_NEAR(red(texture, 1.0F), 1.0F, kRoundoff);
}

TEST(Texture, NearestTakesOneTexel) {
  Texture texture;
  texture.nearest = true;
  EXPECT_EQ(red(texture, 0.26F), 0.2F);
  EXPECT_EQ(red(texture, 0.49F), 0.2F);
  EXPECT_EQ(red(texture, 1.0F), 0.0F);
}

TEST(Texture, SrgbDecodesColoursButNotAlpha) {
  const glm::vec4 value = sampleTexture(ramp(), {}, {0.625F, 0.5F}, ColorSpace::Srgb);
  // The linear value of sRGB 0.4 (IEC 61966-2-1).
  EXPECT_NEAR(value.x, 0.13286832F, kRoundoff);
  EXPECT_NEAR(value.w, 2.0F / 255.0F, kRoundoff);
}

TEST(Texture, NonFiniteAndHugeCoordinatesGiveAValidTexel) {
  for (const float u : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30F}) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat}) {
      Texture texture;
      texture.wrapU = wrap;
      texture.wrapV = wrap;
      const float value = red(texture, u, u);
      EXPECT_TRUE(value >= 0.0F && value <= 1.0F);
    }
  }
}

}  // namespace
}  // namespace walr::render
