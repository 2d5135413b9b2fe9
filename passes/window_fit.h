#pragma once

#include <cstdint>

namespace walr {

/// Number of a-trous iterations whose window, 3^n samples of `size` pixels, comes nearest to a tenth of the image's
/// height: the paper's window at 1080 lines blurs contact shadows away at 216. At least 1.
std::uint32_t fittingIterations(std::uint32_t height, std::uint32_t size = 1);

/// The same window of single pixels, pixels.
std::uint32_t fittingWindow(std::uint32_t height);

}  // namespace walr
