#include "samples/render/image_decode.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include <png.h>
#include <stb_image.h>

#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render {
namespace {

constexpr std::array<std::uint8_t, 4> kPng = {0x89, 'P', 'N', 'G'};
constexpr std::array<std::uint8_t, 3> kJpeg = {0xff, 0xd8, 0xff};
constexpr std::uint32_t kRgba = 4;

bool startsWith(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> signature) {
  return bytes.size() >= signature.size() && std::ranges::equal(bytes.first(signature.size()), signature);
}

/// Check the size before memory is allocated.
/// @param most  texels that the file's bytes could hold
/// @returns an image without texels
Image sizedImage(std::uint32_t width, std::uint32_t height, std::uint64_t most, std::uint64_t texelBudget) {
  const std::string dimensions = std::to_string(width) + " x " + std::to_string(height) + " texels";
  if (width < 1 || height < 1 || width > kMostTexelsASide.most || height > kMostTexelsASide.most) {
    throw SceneError("has " + dimensions + "; the limit is " + std::to_string(kMostTexelsASide.most) + " a side");
  }
  const std::uint64_t texels = std::uint64_t{width} * height;
  if (texels > texelBudget) {
    throw SceneError("has " + dimensions + ", which exceeds the limit for all textures together");
  }
  if (texels > most) throw SceneError("cannot be decoded: its data cannot hold " + dimensions);
  Image image;
  image.width = width;
  image.height = height;
  return image;
}

/// libpng with the bytes that it reads. It reports errors by a jump, so that functions that call it hold no objects
/// with destructors.
class PngReader {
 public:
  explicit PngReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngReader::fail, &PngReader::warn);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw SceneError("cannot be decoded: libpng does not start");
    }
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// Read what stands before the pixels. @returns false after an error
  bool readHeader() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, &PngReader::give);
    // Colour profiles and texts are of no use, and compressed. Exporters get checksums of chunks wrong.
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_set_crc_action(png_, PNG_CRC_WARN_USE, PNG_CRC_QUIET_USE);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // The caller has a better message.
    png_read_info(png_, info_);
    return true;
  }
  /// @param rgba  of the size of the image
  bool readPixels(std::span<std::uint8_t> rgba) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_expand(png_);
    png_set_strip_16(png_);
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);
    // Interlaced images are read in seven passes over all lines.
    for (int pass = png_set_interlace_handling(png_); pass > 0; --pass) {
      for (std::size_t y = 0; y < height(); ++y) png_read_row(png_, &rgba[y * width() * kRgba], nullptr);
    }
    return true;
  }
  [[nodiscard]] std::uint32_t width() const { return png_get_image_width(png_, info_); }
  [[nodiscard]] std::uint32_t height() const { return png_get_image_height(png_, info_); }
  /// How many texels a byte of the file holds at most.
  [[nodiscard]] std::uint64_t texelsOfAByte() const {
    constexpr std::uint64_t kExpansion = 1032;  // Of zlib at most (https://zlib.net/zlib_tech.html).
    return kExpansion * 8 / (png_get_channels(png_, info_) * png_get_bit_depth(png_, info_));
  }
  [[nodiscard]] std::string error() const { return error_.data(); }
  [[nodiscard]] std::string warning() const { return warning_.data(); }

 private:
  using Message = std::array<char, 100>;

  static void copy(png_const_charp from, Message& to) { std::strncpy(to.data(), from, to.size() - 1); }
  static void fail(png_structp png, png_const_charp message) {
    copy(message, static_cast<PngReader*>(png_get_error_ptr(png))->error_);
    png_longjmp(png, 1);
  }
  static void warn(png_structp png, png_const_charp message) {
    copy(message, static_cast<PngReader*>(png_get_error_ptr(png))->warning_);
  }
  static void give(png_structp png, png_bytep bytes, std::size_t count) {
    std::span<const std::uint8_t>& rest = static_cast<PngReader*>(png_get_io_ptr(png))->rest_;
    if (count > rest.size()) png_error(png, "it ends too early");
    std::memcpy(bytes, rest.data(), count);
    rest = rest.subspan(count);
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::span<const std::uint8_t> rest_;
  Message error_{};
  Message warning_{};
};

Image decodePng(std::span<const std::uint8_t> bytes, std::uint64_t texelBudget, std::string& warning) {
  PngReader png(bytes);
  if (!png.readHeader()) throw SceneError("cannot be read: " + png.error());
  Image image = sizedImage(png.width(), png.height(), png.texelsOfAByte() * bytes.size(), texelBudget);
  image.rgba.resize(std::size_t{kRgba} * image.width * image.height);
  if (!png.readPixels(image.rgba)) throw SceneError("cannot be decoded: " + png.error());
  warning = png.warning();
  return image;
}

Image decodeJpeg(std::span<const std::uint8_t> bytes, std::uint64_t texelBudget) {
  // A scan of a progressive JPEG may pass over all texels in some bytes.
  constexpr std::string_view kScan = "\xff\xda";
  constexpr std::string_view kEnd = "\xff\xd9";
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::int64_t scans = 0;
  std::size_t last = 0;
  for (std::size_t at = 0; (at = text.find(kScan, at)) != text.npos; at += kScan.size(), ++scans) last = at;
  if (scans > kMostScans.most) {
    throw SceneError("has " + std::to_string(scans) + " scans; the limit is " + std::to_string(kMostScans.most));
  }
  // Later versions of stb_image make up the rest.
  if (text.find(kEnd, last) == text.npos) throw SceneError("cannot be decoded: it ends too early");
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int components = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &components) == 0) {
    throw SceneError(std::string("cannot be read: ") + stbi_failure_reason());
  }
  // A block of 8 x 8 texels takes at least a bit. stb_image decodes missing ones, too, for seconds.
  constexpr std::uint64_t kTexelsOfAByte = 512;
  Image image = sizedImage(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                           kTexelsOfAByte * bytes.size(), texelBudget);
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> decoded(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &components, int{kRgba}), &stbi_image_free);
  if (!decoded) {
    const std::string reason = stbi_failure_reason();  // Empty at the end of the file.
    throw SceneError("cannot be decoded: " + (reason.empty() ? "it ends too early" : reason));
  }
  image.rgba.assign(decoded.get(), decoded.get() + std::size_t{kRgba} * image.width * image.height);
  return image;
}

}  // namespace

Image decodeImage(std::span<const std::uint8_t> bytes, std::uint64_t& texelBudget, std::string& warning) {
  const bool png = startsWith(bytes, kPng);
  if (!png && !startsWith(bytes, kJpeg)) {
    throw SceneError("not a PNG or JPEG image");
  }
  Image image = png ? decodePng(bytes, texelBudget, warning) : decodeJpeg(bytes, texelBudget);
  texelBudget -= std::uint64_t{image.width} * image.height;
  return image;
}

}  // namespace walr::render
