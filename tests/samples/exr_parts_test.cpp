// Files of several parts and views, and windows that are not the picture.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/image/exr_names.h"
#include "tests/error_text.h"
#include "tests/samples/exr_files.h"
#include "tests/samples/temporary_directory.h"

namespace walr {
namespace {

using test::ExrPart;
using test::valueAt;
using Names = std::vector<std::string>;

class ExrParts : public testing::Test {
 protected:
  void write(const test::ExrFileWish& wish) const { std::ofstream(file, std::ios::binary) << test::exrBytes(wish); }
  /// The value of a channel at the corner of the file's data window.
  [[nodiscard]] float corner(const std::string& channel, const std::string& view = {}) const {
    ExrReader reader(file, view);
    reader.requireBlocks();
    Image image(reader.width(), reader.height(), 1);
    reader.read(std::vector<ExrReader::Target>{{channel, &image, 0}});
    return image.at(0, 0, 0);
  }
  [[nodiscard]] Names channels(const std::string& view = {}) const { return ExrReader(file, view).channels(); }

  test::TemporaryDirectory directory;
  std::filesystem::path file = directory.path() / "parts.exr";
};

// Blender 5 writes whole names of channels into its parts; other programs leave the name of the layer to the part.
TEST_F(ExrParts, ChannelsOfAllPartsAreReadByTheirWholeNames) {
  write({.parts = {ExrPart{.channels = {"ViewLayer.Depth.Z"}, .name = "ViewLayer.Depth"},
                   ExrPart{.channels = {"B", "G", "R"}, .name = "albedo", .tile = 4},
                   ExrPart{.channels = {"Depth.Z"}, .name = "a"}, ExrPart{.channels = {"Depth.Z"}, .name = "b"}}});
  EXPECT_EQ(channels(), (Names{"Depth.Z", "ViewLayer.Depth.Z", "albedo.B", "albedo.G", "albedo.R", "b.Depth.Z"}));
  EXPECT_EQ(corner("ViewLayer.Depth.Z"), valueAt(0, 0, 0));
  EXPECT_EQ(corner("albedo.R"), valueAt(0, 0, 2));
}

// The view stands before the last element of a name, and names of one element belong to the first view.
TEST_F(ExrParts, AViewOfAStereoPictureIsReadByTheNamesOfAPictureWithoutViews) {
  write({.parts = {ExrPart{.channels = {"L.Depth.left.Z", "L.Depth.right.Z", "R", "right.R", "shared.A"}}},
         .views = {"left", "right"}});
  EXPECT_EQ(ExrReader(file).views(), (Names{"left", "right"}));
  EXPECT_EQ(channels("left"), (Names{"L.Depth.Z", "R", "shared.A"}));
  EXPECT_EQ(channels("right"), (Names{"L.Depth.Z", "R", "shared.A"}));
  EXPECT_EQ(corner("L.Depth.Z", "right"), valueAt(0, 0, 1));
  EXPECT_EQ(corner("R", "left"), valueAt(0, 0, 2));
  EXPECT_EQ(channels(), (Names{"L.Depth.left.Z", "L.Depth.right.Z", "R", "right.R", "shared.A"}));
  fg::test::expectError<InputError>([&] { ExrReader(file, "middle"); }, {"parts.exr", "middle", "left, right"});
}

TEST_F(ExrParts, AViewOfSeveralPartsIsThatOfTheirHeaders) {
  write({.parts = {ExrPart{.channels = {"L.Depth.Z"}, .name = "L.Depth-left", .view = "left"},
                   ExrPart{.channels = {"L.Depth.Z", "Y"}, .name = "luma-right", .view = "right"}}});
  EXPECT_EQ(channels("left"), Names{"L.Depth.Z"});
  EXPECT_EQ(channels("right"), (Names{"L.Depth.Z", "luma.Y"}));
  EXPECT_EQ(corner("luma.Y", "right"), valueAt(0, 0, 1));
  EXPECT_EQ(channels(), (Names{"L.Depth.left.Z", "L.Depth.right.Z", "luma.right.Y"}));
}

TEST_F(ExrParts, EveryPartIsReadAtItsPlace) {
  write({.parts = {ExrPart{.channels = {"Y"}, .data = {{-2, 1}, {3, 4}}, .name = "a"},
                   ExrPart{.channels = {"Y"}, .data = {{2, 2}, {4, 6}}, .name = "b"}},
         .display = {{0, 0}, {7, 7}}});
  ExrReader reader(file);
  EXPECT_EQ(reader.dataWindow(), (PixelRect{{-2, 1}, {7, 6}}));
  EXPECT_EQ(reader.displayWindow(), (PixelRect{{0, 0}, {8, 8}}));
  const PixelRect place{{1, 0}, {3, 4}};
  Image image(3, 4, 2);
  for (float& value : image.values()) value = -1.0F;
  reader.read(std::vector<ExrReader::Target>{{"a.Y", &image, 0}, {"b.Y", &image, 1}}, place);
  for (int y = 0; y < 4; ++y) {
    for (int x = 1; x < 4; ++x) {
      EXPECT_EQ(image.at(x - 1, y, 0), y < 1 ? -1.0F : valueAt(x, y, 0)) << x << ' ' << y;
      EXPECT_EQ(image.at(x - 1, y, 1), x < 2 || y < 2 ? -1.0F : valueAt(x, y, 0)) << x << ' ' << y;
    }
  }
}

TEST_F(ExrParts, WritesBothWindowsAndOnlyThePixelsInTheDataWindow) {
  Image image(4, 3, 1);
  image.at(2, 1, 0) = 5.0F;
  const ImagePlace place{{{10, 20}, {4, 3}}, {{12, 21}, {2, 1}}, {{0, 0}, {64, 32}}};
  writeExr(file, std::vector<ExrChannel>{{"Y", &image, 0, ExrType::Half}}, {}, place);
  const ExrReader reader(file);
  EXPECT_EQ(reader.dataWindow(), place.data);
  EXPECT_EQ(reader.displayWindow(), place.display);
  EXPECT_EQ(corner("Y"), 5.0F);
}

TEST_F(ExrParts, NamesWithControlCharactersAreSafeToPrint) {
  write({.parts = {ExrPart{.channels = {"a\x1b[31m.R", "\xc3\xa4.\xff"}}}});
  EXPECT_EQ(channels(), (Names{"a\\x1b[31m.R", "\xc3\xa4.\\xff"}));
  EXPECT_EQ(corner("a\\x1b[31m.R"), valueAt(0, 0, 0));
  // A line feed, DEL, and the C1 control CSI as UTF-8.
  EXPECT_EQ(printable("x\n\x7f\xc2\x9b\xe2\x82\xac"), "x\\x0a\\x7f\\xc2\\x9b\xe2\x82\xac");
}

TEST_F(ExrParts, TellsWhetherTheCompressionChangesValues) {
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    write({.parts = {ExrPart{.channels = {"Y"}, .compression = static_cast<Imf::Compression>(compression)}}});
    // B44, B44A, DWAA and DWAB.
    const bool lossy = compression >= Imf::B44_COMPRESSION && compression <= Imf::DWAB_COMPRESSION;
    EXPECT_EQ(ExrReader(file).lossy(), lossy) << compression;
  }
}

}  // namespace
}  // namespace walr
