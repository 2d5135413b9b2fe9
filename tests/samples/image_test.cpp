#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/OpenEXRConfig.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samples/errors.h"
#include "samples/image/exposure.h"
#include "samples/image/exr.h"
#include "samples/image/file_output.h"
#include "samples/image/png.h"
#include "samples/image/tone_map.h"
#include "tests/error_text.h"
#include "tests/samples/read_png.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr {
namespace {

using test::TemporaryDirectory;

Image ramp(int width, int height, int components) {
  Image image(width, height, components);
  float value = 0.0F;
  for (float& v : image.values()) {
    v = value;
    value += 0.25F;
  }
  return image;
}

TEST(Exr, KeepsValuesTypesAndAttributes) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "a.exr";
  const Image image = ramp(5, 3, 3);
  std::vector<ExrChannel> channels;
  appendChannels(channels, "Some", "XYZ", image, ExrType::Float);
  appendChannels(channels, "Half", "R", image);
  glm::mat4 matrix(1.0F);
  matrix[3][1] = 7.0F;
  writeExr(file, channels,
           std::vector<ExrAttribute>{{"m", matrix}, {"v", glm::vec2(0.25F, -0.5F)}, {"i", 3}, {"s", "text"}});

  ExrReader reader(file);
  EXPECT_EQ(reader.width(), 5);
  EXPECT_EQ(reader.height(), 3);
  EXPECT_EQ(reader.channels(), (std::vector<std::string>{"Half.R", "Some.X", "Some.Y", "Some.Z"}));
  EXPECT_EQ(reader.matrix("m"), matrix);
  EXPECT_EQ(reader.vector("v"), glm::vec2(0.25F, -0.5F));
  EXPECT_EQ(reader.integer("i"), 3);
  EXPECT_THROW(static_cast<void>(reader.matrix("v")), InputError);
  EXPECT_FALSE(reader.matrix("absent").has_value());
  Image read(5, 3, 2);
  reader.read(std::vector<ExrReader::Target>{{"Some.Y", &read, 0}, {"Half.R", &read, 1}});
  for (std::size_t i = 0; i < read.pixelCount(); ++i) {
    EXPECT_EQ(read.pixel(i)[0], image.pixel(i)[1]);
    EXPECT_EQ(read.pixel(i)[1], image.pixel(i)[0]);
  }
}

TEST(Exr, HalfFloatsOutOfRangeSaturateAndNonFiniteOnesStay) {
  const TemporaryDirectory directory;
  Image image(3, 1, 1);
  image.at(0, 0, 0) = 1e6F;
  image.at(1, 0, 0) = -1e6F;
  image.at(2, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  writeExr(directory.path() / "a.exr", std::vector<ExrChannel>{{"Y", &image, 0, ExrType::Half}});
  ExrReader reader(directory.path() / "a.exr");
  reader.read(std::vector<ExrReader::Target>{{"Y", &image, 0}});
  EXPECT_EQ(image.at(0, 0, 0), 65504.0F);
  EXPECT_EQ(image.at(1, 0, 0), -65504.0F);
  EXPECT_TRUE(std::isnan(image.at(2, 0, 0)));
}

TEST(Exr, TruncationAtAnyLengthGivesAnErrorThatNamesTheFile) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "cut.exr";
  const Image image = ramp(40, 40, 1);
  writeExr(file, std::vector<ExrChannel>{{"Y", &image, 0, ExrType::Float}});
  const std::string whole = test::readText(file);
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 40) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, length);
    const auto readWhole = [&] {
      ExrReader reader(file);
      Image read(reader.width(), reader.height(), 1);
      reader.read(std::vector<ExrReader::Target>{{"Y", &read, 0}});
    };
    SCOPED_TRACE(std::to_string(length) + " of " + std::to_string(whole.size()) + " bytes");
    fg::test::expectError<InputError>(readWhole, {"cut.exr"});
  }
}

/// Rewrites the last column and line of a file's data window in its header.
void widen(const std::filesystem::path& file, std::int32_t lastColumn, std::int32_t lastLine) {
  std::string bytes = test::readText(file);
  const std::string name("dataWindow\0box2i\0", 17);
  const std::size_t window = bytes.find(name) + name.size() + sizeof(std::int32_t);
  std::memcpy(bytes.data() + window + 2 * sizeof(std::int32_t), &lastColumn, sizeof(lastColumn));
  std::memcpy(bytes.data() + window + 3 * sizeof(std::int32_t), &lastLine, sizeof(lastLine));
  std::ofstream(file, std::ios::binary) << bytes;
}

void writeOfCompression(const std::filesystem::path& file, Imf::Compression compression) {
  constexpr int kSide = 64;
  Imf::Header header(kSide, kSide);
  header.compression() = compression;
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  std::vector<float> values(kSide * kSide);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  Imf::FrameBuffer buffer;
  buffer.insert("Y",
                Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), kSide * sizeof(float)));
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(buffer);
  output.writePixels(kSide);
}

TEST(Exr, AHeaderThatClaimsMoreThanTheFileHoldsIsRefusedBeforeMemoryIsAllocated) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "widened.exr";
  for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    SCOPED_TRACE(compression);
    writeOfCompression(file, static_cast<Imf::Compression>(compression));
    ExrReader(file).requireBlocks();
    widen(file, 8191, 4095);
    fg::test::expectError<InputError>([&] { ExrReader(file).requireBlocks(); }, {"widened.exr"});
  }
  writeOfCompression(file, Imf::NO_COMPRESSION);
  widen(file, 127, 63);
  const auto read = [&] { ExrReader(file).requireBlocks(); };
  // OpenEXR finds that itself since 3.4.
  if (100 * OPENEXR_VERSION_MAJOR + OPENEXR_VERSION_MINOR < 304) {
    fg::test::expectError<InputError>(read, {"widened.exr", "256 bytes", "claims 512"});
  } else {
    fg::test::expectError<InputError>(read, {"widened.exr"});
  }
}

TEST(Exr, OnlyAWholeImageIsComplete) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "a.exr";
  Image image(16, 9, 1);
  writeExr(file, std::vector<ExrChannel>{{"Y", &image, 0, ExrType::Half}}, {});
  EXPECT_TRUE(isCompleteExr(file));
  const std::string whole = test::readText(file);
  for (const std::size_t length : {std::size_t(0), whole.size() / 2, whole.size() - 1}) {
    test::writeText(file, whole.substr(0, length));
    EXPECT_FALSE(isCompleteExr(file)) << length;
  }
  EXPECT_FALSE(isCompleteExr(directory.path() / "none.exr"));
  ASSERT_EQ(mkfifo((directory.path() / "pipe.exr").c_str(), 0600), 0);
  EXPECT_FALSE(isCompleteExr(directory.path() / "pipe.exr"));
  fg::test::expectError<InputError>([&] { ExrReader(directory.path() / "pipe.exr"); }, {"not a regular file"});
}

TEST(FileOutput, AFailedWriteKeepsTheOldFileAndLeavesNoOther) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "a";
  test::writeText(file, "old");
  std::filesystem::create_directory(directory.path() / "taken");
  const std::string text = "new";
  // A file cannot replace a directory, so that the final rename fails.
  EXPECT_THROW(writeFileAtomically(directory.path() / "taken", std::as_bytes(std::span(text))), OutputError);
  EXPECT_EQ(test::namesIn(directory.path()).size(), 2U);
  writeFileAtomically(file, std::as_bytes(std::span(text)));
  EXPECT_EQ(test::readText(file), "new");
  EXPECT_EQ(test::namesIn(directory.path()).size(), 2U);
}

TEST(FileOutput, FollowsLinksAndWritesToWhatIsNoFileInPlace) {
  namespace fs = std::filesystem;
  const TemporaryDirectory directory;
  const std::string text = "new";
  const auto write = [&](const fs::path& path) { writeFileAtomically(path, std::as_bytes(std::span(text))); };
  test::writeText(directory.path() / "file", "old");
  fs::create_symlink("file", directory.path() / "link");
  fs::create_symlink("later", directory.path() / "dangling");
  write(directory.path() / "link");
  write(directory.path() / "dangling");
  EXPECT_TRUE(fs::is_symlink(directory.path() / "link") && fs::is_symlink(directory.path() / "dangling"));
  EXPECT_EQ(test::readText(directory.path() / "file"), "new");
  EXPECT_EQ(test::readText(directory.path() / "later"), "new");

  const fs::path pipe = directory.path() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  write(pipe);
  std::array<char, 16> received{};
  EXPECT_EQ(read(reader, received.data(), received.size()), 3);
  close(reader);
  EXPECT_EQ(std::string(received.data()), "new");
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(test::namesIn(directory.path()).size(), 5U);

  fs::create_symlink("/dev/full", directory.path() / "full");
  EXPECT_THROW(write(directory.path() / "full"), OutputError);
}

TEST(FileOutput, AnOutputDirectoryThatCannotBeCreatedIsNamed) {
  const TemporaryDirectory directory;
  test::writeText(directory.path() / "file", "");
  for (const auto& path : {directory.path() / "file", directory.path() / "file" / "below"}) {
    fg::test::expectError<OutputError>([&] { prepareOutputDirectory(path); }, {path.string()});
  }
}

TEST(FileOutput, PreparingADirectoryLeavesItEmpty) {
  const TemporaryDirectory directory;
  prepareOutputDirectory(directory.path() / "a" / "b");
  EXPECT_EQ(test::namesIn(directory.path() / "a" / "b").size(), 0U);
}

TEST(ToneMap, FollowsReinhardAndSrgb) {
  EXPECT_EQ(toneMap(0.0F), 0.0F);
  EXPECT_EQ(toneMap(1.0F), 0.5F);
  EXPECT_EQ(toneMap(-3.0F), 0.0F);
  EXPECT_EQ(toneMap(std::numeric_limits<float>::infinity()), 1.0F);
  EXPECT_EQ(encodeSrgb(0.0F), 0.0F);
  EXPECT_NEAR(encodeSrgb(1.0F), 1.0F, 1e-6F);
  // 0.5 is code value 188 of 255 in every table of the sRGB curve.
  EXPECT_EQ(std::lround(255.0F * encodeSrgb(0.5F)), 188);
}

TEST(Png, ToneMapsImagesSideBySide) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "a.png";
  Image left(2, 1, 3);
  Image right(2, 1, 3);
  left.at(0, 0, 0) = 1.0F;
  right.at(1, 0, 2) = 1e30F;
  right.at(0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  writePng(file, {{{&left}, {&right}}});
  EXPECT_EQ(test::readPng(file, 4, 1), (std::vector<std::uint8_t>{188, 0, 0, 0, 0, 0, 255, 0, 255, 0, 0, 255}));
}

TEST(Png, ExposesEachImageSeparatelyAndStacksRows) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "a.png";
  Image one(1, 1, 3);
  one.at(0, 0, 0) = 1.0F;
  Image two(1, 1, 3);
  two.at(0, 0, 0) = 2.0F;
  writePng(file, {{{&one, 0.0F}, {&two, -1.0F}}, {{&one, 1.0F}, {&two, 0.0F}}});
  // 1 / (1 + 1) is code value 188, 2 / (1 + 2) is 213.
  EXPECT_EQ(test::readPng(file, 2, 2), (std::vector<std::uint8_t>{188, 0, 0, 188, 0, 0, 213, 0, 0, 213, 0, 0}));
}

TEST(Png, AGridHoldsEachImagePixelByPixel) {
  constexpr int kWidth = 3, kHeight = 2, kBytes = 3 * kWidth;
  const TemporaryDirectory directory;
  const auto alone = directory.path() / "alone.png", together = directory.path() / "together.png";
  // Values that differ in every pixel of every image.
  std::vector<Image> images(4, Image(kWidth, kHeight, 3));
  for (std::size_t i = 0; i < images.size(); ++i) {
    float value = 0.1F * static_cast<float>(i);
    for (float& v : images[i].values()) v = value += 0.02F;
  }
  writePng(together, {{{&images[0]}, {&images[1]}}, {{&images[2]}, {&images[3]}}});
  const auto grid = test::readPng(together, 2 * kWidth, 2 * kHeight);
  for (std::size_t i = 0; i < images.size(); ++i) {
    SCOPED_TRACE(i);
    writePng(alone, {{{&images[i]}}});
    const auto image = test::readPng(alone, kWidth, kHeight);
    for (std::size_t y = 0; y < kHeight; ++y) {
      const auto row = std::span(image).subspan(y * kBytes, kBytes);
      const auto there = std::span(grid).subspan((i / 2 * kHeight + y) * 2 * kBytes + i % 2 * kBytes, kBytes);
      EXPECT_TRUE(std::ranges::equal(row, there)) << "row " << y;
    }
  }
}

TEST(Exposure, BringsTheLogAverageLuminanceToMiddleGrey) {
  Image picture(4, 1, 3);
  const auto fill = [&](int x, float value) {
    for (int c = 0; c < 3; ++c) picture.at(x, 0, c) = value;
  };
  EXPECT_FALSE(autoExposure(picture).has_value());
  fill(0, 0.36F);
  EXPECT_NEAR(autoExposure(picture).value(), -1.0F, 1e-4F);
  // The mean of the logarithms of 0.72 and 0.18 is that of 0.36. Non-finite pixels do not count.
  fill(1, 0.72F);
  fill(2, 0.18F);
  fill(3, std::numeric_limits<float>::infinity());
  EXPECT_NEAR(autoExposure(picture).value(), -1.0F, 1e-4F);
}

}  // namespace
}  // namespace walr
