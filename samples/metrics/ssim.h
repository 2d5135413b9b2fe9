#pragma once

#include <optional>
#include <span>
#include <vector>

#include "samples/metrics/metrics.h"

namespace walr {

/// Structural similarity at every pixel of two planes of values in 0..1 (see `compare`). NaN where the window does not
/// lie inside the image, and where the mask is zero.
std::vector<double> similarityMap(std::span<const double> test, std::span<const double> reference,
                                  const PixelMask& mask, int width, int height);

/// Mean structural similarity of two planes of values in 0..1 over the pixels of a mask (see `compare`).
/// @returns nullopt if no pixel of the mask has a window that lies inside the image
std::optional<double> structuralSimilarity(std::span<const double> test, std::span<const double> reference,
                                           const PixelMask& mask, int width, int height);

}  // namespace walr
