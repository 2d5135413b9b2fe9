#include "samples/image/png.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <png.h>

#include "samples/errors.h"
#include "samples/image/file_output.h"
#include "samples/image/tone_map.h"

namespace walr {
namespace {

using Rgb8 = std::array<std::uint8_t, 3>;

Rgb8 displayColour(std::span<const float> linear, float scale) {
  Rgb8 colour{};
  for (std::size_t c = 0; c < colour.size(); ++c) {
    if (!std::isfinite(linear[c])) {
      return {255, 0, 255};
    }
    colour.at(c) = static_cast<std::uint8_t>(std::lround(255.0F * encodeSrgb(toneMap(scale * linear[c]))));
  }
  return colour;
}

void write(const std::filesystem::path& path, std::size_t width, std::size_t height, std::span<const Rgb8> pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    throw OutputError("cannot encode " + path.string() + ": " + image.message);
  }
  writeFileAtomically(path, std::span(bytes).first(size));
}

}  // namespace

void writePng(const std::filesystem::path& path, const PictureGrid& grid) {
  const std::size_t columns = grid.front().size();
  const auto width = static_cast<std::size_t>(grid.front().front().picture->width());
  const auto height = static_cast<std::size_t>(grid.front().front().picture->height());
  const std::size_t stride = width * columns;
  std::vector<Rgb8> pixels(stride * height * grid.size());
  for (std::size_t row = 0; row < grid.size(); ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const ExposedPicture& shown = grid[row][column];
      const float scale = std::exp2(shown.exposure);
      const std::size_t corner = row * height * stride + column * width;
      for (std::size_t i = 0; i < width * height; ++i) {
        pixels[corner + i / width * stride + i % width] = displayColour(shown.picture->pixel(i), scale);
      }
    }
  }
  write(path, stride, height * grid.size(), pixels);
}

void writePng(const std::filesystem::path& path, int width, int height, std::span<const std::uint32_t> texels) {
  std::vector<Rgb8> pixels;
  pixels.reserve(texels.size());
  for (const std::uint32_t texel : texels) {
    pixels.push_back({static_cast<std::uint8_t>(texel), static_cast<std::uint8_t>(texel >> 8U),
                      static_cast<std::uint8_t>(texel >> 16U)});
  }
  write(path, static_cast<std::size_t>(width), static_cast<std::size_t>(height), pixels);
}

}  // namespace walr
