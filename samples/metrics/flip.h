#pragma once

#include <optional>
#include <span>
#include <vector>

#include "samples/metrics/display.h"

namespace walr {

/// Pixels per degree of visual angle at which pictures are judged: a monitor of 3840 pixels and 0.7 m width seen from
/// 0.7 m, as in Andersson et al. 2020, 4.1.
inline constexpr double kFlipPixelsPerDegree = 67.0206432765823;

/// LDR-FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild, "FLIP: A Difference Evaluator for
/// Alternating Images", HPG 2020): how strongly an observer who flips between two pictures sees them differ.
/// @param pair  linear RGB in 0..1; the sRGB display that the paper assumes shows it with its own transfer function
/// @returns one value in 0..1 a pixel, 0 where nothing differs
std::vector<double> flipMap(const DisplayedPair& pair, double pixelsPerDegree = kFlipPixelsPerDegree);

/// Mean of a map over the pixels of a mask; nothing where the mask is empty.
std::optional<double> maskedMean(std::span<const double> map, const PixelMask& mask);

}  // namespace walr
