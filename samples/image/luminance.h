#pragma once

#include <span>

namespace walr {

/// Luminance of a linear RGB colour with Rec. 709 primaries (ITU-R BT.709-6, item 3.2).
inline double luminance(std::span<const float> rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

}  // namespace walr
