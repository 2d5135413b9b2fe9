#pragma once

#include <optional>

#include "samples/image/image.h"

namespace walr {

/// The exposure that makes a picture's log-average luminance middle grey, 0.18 before the tone map (Reinhard et al.
/// 2002, equations 1 and 2, key value 0.18). The tone map x / (1 + x) compresses what is brighter, so that highlights
/// need no bound of their own. Pixels that are black or not finite do not count.
/// @param picture  linear RGB
/// @returns stops: the picture is to be multiplied by 2 to this power; nothing where no pixel counts
std::optional<float> autoExposure(const Image& picture);

}  // namespace walr
