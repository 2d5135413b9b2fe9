#pragma once

#include <optional>
#include <span>
#include <vector>

#include "samples/metrics/metrics.h"

namespace walr {

/// Structural similarity of two planes of values in 0..1 at every pixel (see `compare`); not a number where the window
/// does not lie inside the picture or the mask leaves the pixel out.
std::vector<double> similarityMap(std::span<const double> test, std::span<const double> reference,
                                  const PixelMask& mask, int width, int height);

/// Mean structural similarity of two planes of values in 0..1 over the pixels of a mask (see `compare`).
/// @returns nothing where no masked pixel has a whole window
std::optional<double> structuralSimilarity(std::span<const double> test, std::span<const double> reference,
                                           const PixelMask& mask, int width, int height);

}  // namespace walr
