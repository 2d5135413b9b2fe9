#pragma once

#include <cstdint>

#include "samples/render/film.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "samples/sequence/frame.h"

namespace walr::render {

/// Which part of the picture a reference covers, and what of a pixel.
struct ReferenceCoverage {
  /// Average over the pixel's area, as anti-aliasing tends to, rather than light at the view's sample position.
  bool wholePixel = false;
  /// Render one of so many squares of 64 x 64 pixels, evenly spread and the same in every frame; the others hold no
  /// numbers, which errors leave out. Errors of a large picture then cost no more than those of a small one.
  std::uint32_t oneSquareIn = 1;
};

/// Light of many paths: their mean, 0 where no path starts on a diffuse surface. An even number of paths goes in two
/// independent halves, of which the first is kept beside the mean, so that the reference's own noise can be told
/// (`referenceNoise`).
/// @param settings  `gbuffer` does not count: light is gathered at first hits
/// @param rays      set to the number of rays traced
walr::Reference renderReference(const World& world, const View& view, const SamplingSettings& settings,
                                const ReferenceCoverage& coverage, std::uint64_t& rays);

}  // namespace walr::render
