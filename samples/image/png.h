#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "samples/image/image.h"

namespace walr {

/// Write linear RGB pictures of one size side by side as one 8-bit PNG: tone-mapped by x / (1 + x), then sRGB. Values
/// that are not finite show as magenta.
/// @throws OutputError
void writePng(const std::filesystem::path& path, std::span<const Image* const> pictures);

/// Write a picture of RGBA8 texels (red in the lowest byte, rows from the top) as an 8-bit RGB PNG; alpha is dropped.
/// @throws OutputError
void writePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint32_t> texels);

}  // namespace walr
