#pragma once

#include <cstdint>
#include <vector>

#include "samples/image/image.h"

namespace walr {

/// One flag per pixel: non-zero where the pixel counts.
using PixelMask = std::vector<std::uint8_t>;

/// A denoised image (`test`) and its reference after the tone map: linear RGB in 0..1.
struct DisplayedPair {
  Image test;
  Image reference;
};

/// Tone-map (`toneMap`) two linear RGB images of one size. Pixels outside the mask take the reference's value in both
/// images, so that they show no error. A non-finite value of `test` becomes 0 or 1, whichever is farther from the
/// reference: the largest possible error. A non-finite value of the reference becomes 0; masks should leave out such
/// pixels.
DisplayedPair display(const Image& test, const Image& reference, const PixelMask& mask);

}  // namespace walr
