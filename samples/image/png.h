#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "samples/image/image.h"

namespace walr {

/// A linear RGB image and its exposure.
struct ExposedPicture {
  const Image* picture;
  float exposure = 0.0F;  ///< Stops: values are multiplied by 2 to this power before the tone map.
};

/// Rows of images. All rows have the same length, and all images the same size.
using PictureGrid = std::vector<std::vector<ExposedPicture>>;

/// Write a grid of images as one 8-bit PNG: exposed, tone-mapped by x / (1 + x), then sRGB. Pixels with non-finite
/// values become magenta.
/// @throws OutputError
void writePng(const std::filesystem::path& path, const PictureGrid& grid);

/// Write an image of RGBA8 texels (red in the lowest byte, rows from the top) as an 8-bit RGB PNG; alpha is dropped.
/// @throws OutputError
void writePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint32_t> texels);

}  // namespace walr
