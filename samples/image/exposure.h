#pragma once

#include <optional>

#include "samples/image/image.h"

namespace walr {

/// The exposure that maps an image's log-average luminance to 0.18 before the tone map (Reinhard et al. 2002, equations
/// 1 and 2, key value 0.18). Highlights need no bound, because the tone map x / (1 + x) compresses them. Black and
/// non-finite pixels do not count.
/// @param picture  linear RGB
/// @returns exposure in stops: multiply the image by 2 to this power; nullopt if no pixel counts
std::optional<float> autoExposure(const Image& picture);

}  // namespace walr
