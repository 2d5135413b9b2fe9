// Animations in WebP, read back with the format's own library.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <webp/demux.h>

#include "samples/errors.h"
#include "samples/image/webp_animation.h"
#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"

namespace walr {
namespace {

constexpr int kWidth = 37;
constexpr int kHeight = 20;
constexpr std::array<std::uint32_t, 3> kColours = {0xff2040c0, 0xff30a050, 0xff808080};  // Red in the lowest byte.

TEST(WebpAnimation, KeepsFramesTimesAndColours) {
  const test::TemporaryDirectory folder;
  const std::string path = folder.path() / "animation.webp";
  WebpAnimation animation(kWidth, kHeight, 24.0);
  for (const std::uint32_t colour : kColours) animation.add(std::vector<std::uint32_t>(kWidth * kHeight, colour));
  animation.write(path);

  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  const std::unique_ptr<WebPAnimDecoder, decltype(&WebPAnimDecoderDelete)> decoder(WebPAnimDecoderNew(&data, nullptr),
                                                                                   WebPAnimDecoderDelete);
  ASSERT_NE(decoder, nullptr);
  WebPAnimInfo info;
  ASSERT_NE(WebPAnimDecoderGetInfo(decoder.get(), &info), 0);
  EXPECT_EQ(info.canvas_width, std::uint32_t{kWidth});
  EXPECT_EQ(info.canvas_height, std::uint32_t{kHeight});
  EXPECT_EQ(info.frame_count, kColours.size());
  EXPECT_EQ(info.loop_count, 0U) << "0: without end";
  const std::array<int, kColours.size()> ends = {42, 83, 125};  // Milliseconds: multiples of 1000 / 24, rounded.
  for (std::size_t frame = 0; frame < kColours.size(); ++frame) {
    std::uint8_t* texels = nullptr;
    int end = 0;
    ASSERT_NE(WebPAnimDecoderGetNext(decoder.get(), &texels, &end), 0);
    EXPECT_EQ(end, ends.at(frame));
    for (unsigned channel = 0; channel < 3; ++channel) {
      const int wanted = static_cast<int>(kColours.at(frame) >> (8 * channel) & 0xffU);
      // 8-bit luma and chroma of the video range: half a step of each moves a channel by up to 1.8 levels. The quality
      // of 90 allows half a step of the quantized coefficients more, which for a constant block is below 2 levels.
      EXPECT_NEAR(texels[channel], wanted, 4) << "frame " << frame << ", channel " << channel;
    }
  }
}

TEST(WebpAnimation, RefusesSizesThatTheFormatLacks) {
  fg::test::expectError<OutputError>([] { WebpAnimation(16384, 10, 24.0); }, {"16384 x 10", "16383"});
  fg::test::expectError<OutputError>([] { WebpAnimation(10, 0, 24.0); }, {"10 x 0"});
}

}  // namespace
}  // namespace walr
