#pragma once

#include <cstdint>

namespace walr {

/// Number of a-trous iterations whose window, 3^n texels of `size` pixels, comes nearest to a tenth of the image's
/// height; at least 1. The paper's window, made for 1080 lines, blurs contact shadows away at 216.
std::uint32_t fittingIterations(std::uint32_t height, std::uint32_t size = 1);

/// Side of the blocks in pixels that suits an image: 1/43 of its height, at least 4. Larger blocks lose detail at 216
/// lines; smaller ones show no more at 270 and above.
std::uint32_t fittingBlockSize(std::uint32_t height);

/// Side of the window of `fittingIterations` over single pixels, pixels.
std::uint32_t fittingWindow(std::uint32_t height);

}  // namespace walr
