#include "samples/render/image_decode.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string>

#include <stb_image.h>
#include <zlib.h>

#include "samples/render/scene_error.h"

namespace walr::render {
namespace {

constexpr std::array<std::uint8_t, 4> kPng = {0x89, 'P', 'N', 'G'};
constexpr std::array<std::uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};

bool startsWith(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> signature) {
  return bytes.size() >= signature.size() && std::ranges::equal(bytes.first(signature.size()), signature);
}

/// Refuse a PNG whose data expand to more bytes than its pixels have: stb_image expands all of them, up to 4 GiB.
void refuseExpansion(std::span<const std::uint8_t> png, std::uint64_t width, std::uint64_t height) {
  // Of 16-bit RGBA. A line begins with a byte for its filter, and interlaced lines are less than twice as many.
  const std::uint64_t most = 8 * width * height + 2 * height + 64;
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw SceneError("cannot be decoded: zlib does not start");
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> owner(&stream, &inflateEnd);
  std::array<std::uint8_t, 1U << 14U> discarded{};
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kChunkHeader = 8;  // Length and name; a checksum of four bytes ends the chunk.
  std::span<const std::uint8_t> rest = png.subspan(std::min(png.size(), kSignature));
  int state = Z_OK;
  while (state == Z_OK && rest.size() >= kChunkHeader) {
    const std::size_t length =
        std::size_t{rest[0]} << 24U | std::size_t{rest[1]} << 16U | std::size_t{rest[2]} << 8U | rest[3];
    const bool holdsPixels = std::memcmp(&rest[4], "IDAT", 4) == 0;
    rest = rest.subspan(kChunkHeader);
    const std::span<const std::uint8_t> data = rest.first(std::min(rest.size(), length));
    rest = rest.subspan(std::min(rest.size(), length + 4));
    if (!holdsPixels) continue;
    stream.next_in = const_cast<std::uint8_t*>(data.data());  // zlib does not write there.
    stream.avail_in = static_cast<unsigned>(data.size());
    while (stream.avail_in > 0 && state == Z_OK) {
      stream.next_out = discarded.data();
      stream.avail_out = static_cast<unsigned>(discarded.size());
      state = inflate(&stream, Z_NO_FLUSH);
      if (stream.total_out > most) throw SceneError("cannot be decoded: its data are larger than its pixels");
    }
  }
  // stb_image would expand what has no header, too.
  if (state != Z_OK && stream.total_out == 0) throw SceneError("cannot be decoded: its data are damaged");
}

}  // namespace

Image decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t& texelBudget) {
  constexpr int kLargestSide = 16384;
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int components = 0;
  // stb_image reads more formats than glTF allows. They are refused, because their decoders are little tested.
  const bool png = startsWith(bytes, kPng);
  if (!png && !startsWith(bytes, kJpeg)) {
    throw SceneError("not a PNG or JPEG image");
  }
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &components) == 0) {
    throw SceneError(std::string("cannot be read: ") + stbi_failure_reason());
  }
  const std::string dimensions = std::to_string(width) + " x " + std::to_string(height) + " texels";
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw SceneError("has " + dimensions + "; the limit is " + std::to_string(kLargestSide) + " a side");
  }
  const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (texels > texelBudget) {
    throw SceneError("has " + dimensions + ", which exceeds the limit for all textures together");
  }
  if (png) refuseExpansion(bytes, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
  constexpr int kRgba = 4;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> decoded(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &components, kRgba), &stbi_image_free);
  if (!decoded) {
    const std::string reason = stbi_failure_reason();  // Empty at the end of the file.
    throw SceneError("cannot be decoded: " + (reason.empty() ? "it ends too early" : reason));
  }
  texelBudget -= texels;
  Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  image.rgba.assign(decoded.get(), decoded.get() + texels * kRgba);
  return image;
}

}  // namespace walr::render
