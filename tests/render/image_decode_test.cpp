#include "samples/render/image_decode.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

#include "samples/render/scene_error.h"
#include "tests/error_text.h"

namespace walr::render {
namespace {

void append(std::vector<std::uint8_t>& bytes, const void* data, std::size_t size) {
  const auto* const first = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

void appendNumber(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> unsigned(shift)));
}

void appendChunk(std::vector<std::uint8_t>& png, const char* name, const std::vector<std::uint8_t>& data) {
  appendNumber(png, static_cast<std::uint32_t>(data.size()));
  append(png, name, 4);
  append(png, data.data(), data.size());
  uLong checksum = crc32(0, reinterpret_cast<const Bytef*>(name), 4);
  if (!data.empty()) checksum = crc32(checksum, data.data(), static_cast<uInt>(data.size()));
  appendNumber(png, static_cast<std::uint32_t>(checksum));
}

/// A grey PNG of 8 bits whose data, all zero, have a size of their own.
std::vector<std::uint8_t> greyPng(std::uint32_t side, std::size_t dataBytes) {
  std::vector<std::uint8_t> png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  std::vector<std::uint8_t> header;
  appendNumber(header, side);
  appendNumber(header, side);
  header.insert(header.end(), {8, 0, 0, 0, 0});
  appendChunk(png, "IHDR", header);
  const std::vector<std::uint8_t> data(dataBytes);
  uLongf size = compressBound(data.size());
  std::vector<std::uint8_t> compressed(size);
  EXPECT_EQ(compress(compressed.data(), &size, data.data(), data.size()), Z_OK);
  compressed.resize(size);
  appendChunk(png, "IDAT", compressed);
  appendChunk(png, "IEND", {});
  return png;
}

TEST(DecodeImage, ASmallPngDoesNotExpandToMoreThanItsPixels) {
  std::uint64_t budget = 1000;
  // A line is a byte for its filter and a byte for each pixel.
  EXPECT_EQ(decodeImage(greyPng(4, 4 * 5), budget).width, 4U);
  fg::test::expectError<SceneError>([&] { decodeImage(greyPng(4, std::size_t{1} << 24U), budget); },
                                    {"larger than its pixels"});
}

}  // namespace
}  // namespace walr::render
