#pragma once

#include <optional>
#include <span>
#include <vector>

#include "samples/metrics/display.h"

namespace walr {

/// Pixels per degree of visual angle, which FLIP assumes for the observer: a monitor 3840 pixels and 0.7 m wide, seen
/// from 0.7 m (Andersson et al. 2020, 4.1).
inline constexpr double kFlipPixelsPerDegree = 67.0206432765823;

/// LDR-FLIP (Andersson et al. 2020): the difference that an observer perceives who flips between two images.
/// @param pair    linear RGB in 0..1, before the sRGB transfer function
/// @param wanted  the pixels whose difference is wanted; a few of them cost less time than all
/// @returns one value in 0..1 per pixel, 0 where the images look equal and where the mask is zero
std::vector<double> flipMap(const DisplayedPair& pair, const PixelMask& wanted,
                            double pixelsPerDegree = kFlipPixelsPerDegree);

/// Mean of a map over the pixels of a mask; nullopt if the mask is empty.
std::optional<double> maskedMean(std::span<const double> map, const PixelMask& mask);

}  // namespace walr
