#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace walr {

/// Encodes images as an animation in a WebP file. It repeats without end.
class WebpAnimation {
 public:
  /// @param width, height  in pixels, 1 to 16383: the format's limits
  /// @throws OutputError if the format does not take such images
  WebpAnimation(int width, int height, double framesPerSecond);
  ~WebpAnimation();
  WebpAnimation(const WebpAnimation&) = delete;
  WebpAnimation& operator=(const WebpAnimation&) = delete;

  /// Append an image of RGBA8 texels (red in the lowest byte, rows from the top); alpha is dropped.
  /// @throws OutputError
  void add(std::span<const std::uint32_t> texels);
  /// Write the file with all images added so far. Call once, at the end.
  /// @throws OutputError; see `writeFileAtomically`
  void write(const std::filesystem::path& path);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace walr
