#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "samples/image/image.h"

namespace walr {

/// A linear RGB picture and how it is to be shown.
struct ExposedPicture {
  const Image* picture;
  float exposure = 0.0F;  ///< Stops: values are multiplied by 2 to this power before the tone map.
};

/// Rows of pictures, each row as long as the first; all pictures of one size.
using PictureGrid = std::vector<std::vector<ExposedPicture>>;

/// Write pictures beside and below one another as one 8-bit PNG: exposed, tone-mapped by x / (1 + x), then sRGB. Values
/// that are not finite show as magenta.
/// @throws OutputError
void writePng(const std::filesystem::path& path, const PictureGrid& grid);

/// Write a picture of RGBA8 texels (red in the lowest byte, rows from the top) as an 8-bit RGB PNG; alpha is dropped.
/// @throws OutputError
void writePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint32_t> texels);

}  // namespace walr
