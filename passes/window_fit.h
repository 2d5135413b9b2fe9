#pragma once

#include <cstdint>

namespace walr {

/// Number of a-trous iterations whose window, 3^n samples of `size` pixels, comes nearest to a tenth of the image's
/// height: the paper's window at 1080 lines blurs contact shadows away at 216. At least 1.
std::uint32_t fittingIterations(std::uint32_t height, std::uint32_t size = 1);

/// Side of the blocks whose detail is enough for a picture: 1/43 of the height, 4 at least. Larger ones lose detail at
/// 216 lines, and at 270 and above smaller ones show no more, pixels.
std::uint32_t fittingBlockSize(std::uint32_t height);

/// The same window of single pixels, pixels.
std::uint32_t fittingWindow(std::uint32_t height);

}  // namespace walr
