#pragma once

#include <filesystem>
#include <span>

#include "samples/image/image.h"

namespace walr {

/// Write linear RGB pictures of one size side by side as one 8-bit PNG: tone-mapped by x / (1 + x), then sRGB. Values
/// that are not finite show as magenta.
/// @throws OutputError
void writePng(const std::filesystem::path& path, std::span<const Image* const> pictures);

}  // namespace walr
