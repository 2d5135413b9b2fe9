#pragma once

#include <cstdint>

#include "samples/render/film.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "samples/sequence/frame.h"

namespace walr::render {

/// Which pixels of the image a reference covers, and which part of each pixel.
struct ReferenceCoverage {
  /// True: the light's average over the pixel's area, which anti-aliased output converges to. False: the light at the
  /// view's sample position.
  bool wholePixel = false;
  /// Render one of this many squares of 64 x 64 pixels, spread evenly and the same in every frame. The others are
  /// filled with NaN, and error metrics leave them out. This limits the cost of references for large images.
  std::uint32_t oneSquareIn = 1;

  /// Each row of squares is shifted by the golden ratio of the period, so that the chosen squares do not form columns.
  [[nodiscard]] std::uint32_t rowShift() const;
  /// Whether a pixel lies in a square that is rendered.
  [[nodiscard]] bool covers(std::uint32_t x, std::uint32_t y) const;
};

/// The seed of the second half of a reference's samples.
inline std::uint32_t seedOfSecondHalf(std::uint32_t seed) {
  return ~seed ^ 1U;
}

/// Render a reference: the mean of many samples per pixel, 0 where no sample starts on a diffuse surface. If the number
/// of samples is even, they form two independent halves. The mean of the first half is stored, too, so that the
/// reference's own noise can be estimated (`referenceNoise`).
/// @param settings  `gbuffer`: with `Material`, light is gathered behind mirrors, but not that of glossy metals
/// @param rays      set to the number of rays traced
walr::Reference renderReference(const World& world, const View& view, const SamplingSettings& settings,
                                const ReferenceCoverage& coverage, std::uint64_t& rays);

}  // namespace walr::render
