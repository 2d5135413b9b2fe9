#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace walr::render {

/// Random numbers for one path: each call returns the next dimensions of the path's sample point.
///
/// `Sobol`: padded two-dimensional Sobol sequences, each independently Owen-scrambled and shuffled (Burley 2020). The
/// samples of one pixel are well distributed in every pair of dimensions, within a frame and over frames. Different
/// pixels are independent.
///
/// `BlueNoise`: well distributed over the image instead. All pixels share one sequence per frame. Each pixel takes the
/// point whose index is the pixel's position on a Z-order curve with quadrants shuffled at every level (Ahmed and Wonka
/// 2020). The errors of neighbouring pixels then differ, so that a spatial filter removes them well. The samples of one
/// pixel are independent.
///
/// `Independent`: independent uniform numbers.
class Sampler {
 public:
  enum class Kind : std::uint8_t { Sobol, BlueNoise, Independent };

  /// @param seed   selects one of 2^32 independent sets of sequences
  /// @param pixel  the pixel's column in the lower 16 bits, its row in the upper 16 bits
  /// @param index  number of the sample within the pixel's sequence, over all frames
  Sampler(Kind kind, std::uint32_t seed, std::uint32_t pixel, std::uint32_t index);

  /// In [0, 1).
  float next1D() { return next2D().x; }
  /// In [0, 1) x [0, 1).
  glm::vec2 next2D();

 private:
  [[nodiscard]] glm::vec2 sharedPoint(std::uint32_t seed) const;

  Kind kind_;
  std::uint32_t seed_;
  std::uint32_t place_;  // Position on the Z-order curve.
  std::uint32_t sequence_;
  std::uint32_t index_;
  std::uint32_t dimension_ = 0;
};

}  // namespace walr::render
