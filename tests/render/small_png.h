#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

namespace walr::render::test {

/// A number with its highest byte first.
inline std::string pngNumber(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> static_cast<unsigned>(shift));
  return bytes;
}

inline std::string pngChunk(const std::string& name, const std::string& data) {
  const std::string checked = name + data;
  const uLong checksum = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return pngNumber(static_cast<std::uint32_t>(data.size())) + checked + pngNumber(static_cast<std::uint32_t>(checksum));
}

/// A square PNG, by the specification.
/// @param colour  0: grey, 2: RGB, 3: palette of four colours, 4: grey and alpha, 6: RGBA
/// @param data    before compression: for each line a byte for its filter, and its pixels
inline std::string smallPng(std::uint32_t side, int bits, int colour, bool interlaced, const std::string& data) {
  uLongf size = compressBound(data.size());
  std::string compressed(size, '\0');
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                     data.size()),
            Z_OK);
  compressed.resize(size);
  const std::string kinds{static_cast<char>(bits), static_cast<char>(colour), '\0', '\0',
                          static_cast<char>(interlaced)};
  const std::string palette = colour == 3 ? pngChunk("PLTE", "abcdefghijkl") : "";
  return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", pngNumber(side) + pngNumber(side) + kinds) + palette +
         pngChunk("IDAT", compressed) + pngChunk("IEND", "");
}

}  // namespace walr::render::test
