#pragma once

#include <cstdint>
#include <vector>

#include "samples/image/image.h"

namespace walr {

/// One flag a pixel: non-zero where it counts.
using PixelMask = std::vector<std::uint8_t>;

/// A result and its reference as a display would show them: linear RGB in 0..1.
struct DisplayedPair {
  Image test;
  Image reference;
};

/// Tone-map (`toneMap`) two linear RGB pictures of one size. Pixels outside the mask take the reference's value in both
/// pictures. A value of `test` that is not finite becomes the worst that the tone map can give: 0 or 1, whichever is
/// farther from the reference. Reference values that are not finite become 0; no mask should hold such pixels.
DisplayedPair display(const Image& test, const Image& reference, const PixelMask& mask);

}  // namespace walr
