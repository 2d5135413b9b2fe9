// The texels of images, by the specification of PNG, and what is told of damaged ones.
#include "samples/render/image_decode.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"
#include "tests/error_text.h"
#include "tests/render/small_jpeg.h"
#include "tests/render/small_png.h"

namespace walr::render {
namespace {

using Bytes = std::vector<std::uint8_t>;

Image decode(const std::string& bytes, std::string& warning) {
  std::uint64_t budget = kMostTexels.most;
  return decodeImage({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, budget, warning);
}

std::string textOf(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

struct Kind {
  int bits;
  int colour;  ///< As of `smallPng`.
  Bytes data;  ///< Of 2 x 2 texels: lines begin with a filter, 0 for none.
  Bytes rgba;
  Bytes transparency = {};  ///< Of a chunk tRNS.
  bool interlaced = false;
};

TEST(ImageDecode, TexelsOfEachKindOfPng) {
  const Kind kinds[] = {
      {1, 0, {0, 0x80, 0, 0x40}, {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255}},
      {2, 0, {0, 0x10, 0, 0xb0}, {0, 0, 0, 255, 85, 85, 85, 255, 170, 170, 170, 255, 255, 255, 255, 255}},
      {4, 0, {0, 0x1a, 0, 0x0f}, {17, 17, 17, 255, 170, 170, 170, 255, 0, 0, 0, 255, 255, 255, 255, 255}},
      {8, 0, {0, 1, 2, 0, 3, 4}, {1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255, 4, 4, 4, 255}},
      // The first texel of a line comes with a filter that adds its left neighbour to the second one.
      {8, 0, {1, 1, 2, 1, 3, 4}, {1, 1, 1, 255, 3, 3, 3, 255, 3, 3, 3, 255, 7, 7, 7, 255}},
      {8, 0, {0, 1, 2, 0, 3, 4}, {1, 1, 1, 255, 2, 2, 2, 0, 3, 3, 3, 255, 4, 4, 4, 255}, {0, 2}},
      {16, 0, {0, 1, 9, 2, 9, 0, 3, 9, 4, 9}, {1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255, 4, 4, 4, 255}},
      {8,
       2,
       {0, 1, 2, 3, 4, 5, 6, 0, 7, 8, 9, 10, 11, 12},
       {1, 2, 3, 255, 4, 5, 6, 0, 7, 8, 9, 255, 10, 11, 12, 255},
       {0, 4, 0, 5, 0, 6}},
      // The palette is "abcdefghijkl".
      {2, 3, {0, 0x10, 0, 0xb0}, {'a', 'b', 'c', 7, 'd', 'e', 'f', 8, 'g', 'h', 'i', 255, 'j', 'k', 'l', 255}, {7, 8}},
      {8, 3, {0, 3, 2, 0, 1, 0}, {'j', 'k', 'l', 255, 'g', 'h', 'i', 255, 'd', 'e', 'f', 255, 'a', 'b', 'c', 255}},
      {8, 4, {0, 1, 2, 3, 4, 0, 5, 6, 7, 8}, {1, 1, 1, 2, 3, 3, 3, 4, 5, 5, 5, 6, 7, 7, 7, 8}},
      {8,
       6,
       {0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 9, 10, 11, 12, 13, 14, 15, 16},
       {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}},
      // Of the seven passes, three have texels: the first one, the second one, and the second line.
      {8, 0, {0, 1, 0, 2, 0, 3, 4}, {1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255, 4, 4, 4, 255}, {}, true},
  };
  for (const Kind& kind : kinds) {
    SCOPED_TRACE("bits " + std::to_string(kind.bits) + ", colour " + std::to_string(kind.colour));
    std::string png = test::smallPng(2, kind.bits, kind.colour, kind.interlaced, textOf(kind.data));
    if (!kind.transparency.empty()) {
      png.insert(png.find("IDAT") - 4, test::pngChunk("tRNS", textOf(kind.transparency)));
    }
    std::string warning;
    EXPECT_EQ(decode(png, warning).rgba, kind.rgba);
    EXPECT_EQ(warning, "");
  }
}

TEST(ImageDecode, AWrongChecksumIsTold) {
  std::string png = test::smallPng(2, 8, 0, false, textOf({0, 1, 2, 0, 3, 4}));
  png[png.find("IEND") - 5] ^= 1;  // The end of the checksum of the texels.
  std::string warning;
  EXPECT_EQ(decode(png, warning).rgba[4], 2);
  EXPECT_NE(warning.find("IDAT: CRC error"), std::string::npos) << warning;
}

TEST(ImageDecode, AJpegThatEndsTooEarlyIsRefused) {
  std::string jpeg = test::smallJpeg();
  std::string warning;
  EXPECT_EQ(decode(jpeg, warning).width, 24U);
  jpeg.resize(jpeg.size() - 6);
  fg::test::expectError<SceneError>([&] { decode(jpeg, warning); }, {"it ends too early"});
}

// A scan of 30 bytes of a progressive JPEG took 70 ms per million texels.
TEST(ImageDecode, ScansOfAJpegAreCounted) {
  std::string jpeg = test::smallJpeg();
  const std::size_t at = jpeg.find("\xff\xda");
  const std::string scan = jpeg.substr(at, jpeg.size() - 2 - at);
  for (int more = 0; more < kMostScans.most; ++more) jpeg.insert(at, scan);
  std::string warning;
  fg::test::expectError<SceneError>([&] { decode(jpeg, warning); }, {"has 65 scans; the limit is 64"});
}

}  // namespace
}  // namespace walr::render
