#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace walr::render {

/// Random numbers for one path: each call gives the next dimensions of the path's sample.
///
/// `Sobol` pads two-dimensional Sobol sequences, each Owen-scrambled and shuffled on its own (Burley 2020): the samples
/// of one pixel are well spread in every dimension pair, over the samples of a frame and over frames, and independent
/// between pixels.
///
/// `BlueNoise` spreads the samples over the picture instead: in each frame every pixel takes one point of a sequence
/// that all share, by the pixel's place on a Z-order curve whose quadrants are shuffled at every level (Ahmed and
/// Wonka 2020). Neighbours' errors then differ, which filters over pixels take away; samples of one pixel are
/// independent.
///
/// `Independent` draws uniform numbers.
class Sampler {
 public:
  enum class Kind : std::uint8_t { Sobol, BlueNoise, Independent };

  /// @param seed   picks one of 2^32 independent sequences, before `pixel` does
  /// @param pixel  the pixel's column in the lower 16 bits, its row in the upper
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
  std::uint32_t place_;  // On the Z-order curve.
  std::uint32_t sequence_;
  std::uint32_t index_;
  std::uint32_t dimension_ = 0;
};

}  // namespace walr::render
