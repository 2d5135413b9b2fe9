#pragma once

#include <random>

#include <glm/glm.hpp>

#include "tests/passes/reference/frame.h"
#include "tests/passes/reference/image.h"
#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/storage.h"

/// Light with residuals that the fits over blocks miss, for tests of the share of accumulated light.
namespace walr::test {

using reference::Image;

inline constexpr glm::ivec2 kSize(61, 43);  // Not a multiple of the tiles.
inline constexpr std::uint32_t kBlock = 4;
inline constexpr int kTile = 8;    // Pixels per axis: two blocks.
inline constexpr int kBefore = 2;  // Pixels of the first tile before the image: half a block.
inline constexpr double kSamples = 8.0;

inline double luminanceOf(const glm::dvec4& colour) {
  return reference::luminance(glm::dvec3(colour));
}

/// The light that a filter reads: this frame's, and its mean with a history of kSamples - 1 frames.
struct ResidualLight {
  Image<glm::dvec4> truth{kSize};
  Image<glm::dvec4> lighting{kSize};
  Image<glm::dvec4> mean{kSize};
};

/// Light with stripes of two pixels that no guide shows, and with noise.
/// @param stripes difference of the stripes from their mean, over this mean
/// @param noise   standard deviation of one sample over its mean
inline ResidualLight stripedLight(double stripes, double noise) {
  std::mt19937 random(7);
  // A gamma distribution has this relative deviation at the shape 1 / noise^2; the sum of n samples is n times the
  // shape.
  const auto meanOf = [&](double samples) {
    if (noise == 0.0) return 1.0;
    const double shape = samples / (noise * noise);
    return std::gamma_distribution<double>(shape, 1.0 / shape)(random);
  };
  ResidualLight light;
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

/// The same with noise that light and history share, of standard deviation .55 of the light.
inline ResidualLight withSharedNoise(ResidualLight light) {
  constexpr double kShape = 1.0 / (0.55 * 0.55);
  std::mt19937 random(11);
  std::gamma_distribution<double> factor(kShape, 1.0 / kShape);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double shared = factor(random);
    for (Image<glm::dvec4>* image : {&light.lighting, &light.mean}) {
      for (int c = 0; c < 3; ++c) (*image)[p][c] = reference::roundToHalf(shared * (*image)[p][c]);
    }
  });
  return light;
}

/// Light and history that differ from their mean in patterns whose product is 0 in the mean, as noise does.
inline ResidualLight unrelatedLight() {
  ResidualLight light;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const double y = p.x % 2 == 0 ? 1.9 : 0.1, h = p.y % 2 == 0 ? 1.7 : 0.3;
    light.lighting[p] = glm::dvec4(glm::dvec3(y), 1.0);
    light.mean[p] = glm::dvec4(glm::dvec3(h + (y - h) / kSamples), kSamples);
  });
  return light;
}

}  // namespace walr::test
