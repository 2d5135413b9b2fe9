// What a header may make the OpenEXR library allocate, and how long a damaged file may take.
#include "samples/image/exr_limits.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "tests/damaged_files.h"
#include "tests/error_text.h"
#include "tests/limits_table.h"
#include "tests/samples/exr_files.h"
#include "tests/samples/temporary_directory.h"

namespace walr {
namespace {

using test::ExrPart;

/// Where an attribute of a header lies in the bytes of a file.
struct Place {
  std::size_t name = 0;
  std::size_t type = 0;
  std::size_t size = 0;
  std::size_t value = 0;
  std::size_t end = 0;
};

std::uint32_t numberAt(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, &bytes[at], sizeof number);
  return number;
}

template <typename Number>
void setNumber(std::string& bytes, std::size_t at, Number number) {
  std::memcpy(&bytes[at], &number, sizeof number);
}

/// The attributes of the first header, by the specification: name, type, size, value.
std::vector<Place> attributesOf(const std::string& bytes) {
  std::vector<Place> places;
  for (std::size_t at = 8; bytes[at] != '\0'; at = places.back().end) {
    Place place{.name = at};
    place.type = bytes.find('\0', place.name) + 1;
    place.size = bytes.find('\0', place.type) + 1;
    place.value = place.size + 4;
    place.end = place.value + numberAt(bytes, place.size);
    places.push_back(place);
  }
  return places;
}

Place find(const std::string& bytes, const std::string& name) {
  for (const Place& place : attributesOf(bytes)) {
    if (bytes.compare(place.name, name.size() + 1, name.c_str(), name.size() + 1) == 0) return place;
  }
  ADD_FAILURE() << name;
  return {};
}

/// Reads a file as `walr lint` does: all channels, after its blocks were checked.
void readWhole(const std::filesystem::path& file) {
  ExrReader reader(file);
  reader.requireBlocks();
  std::vector<ExrReader::Target> targets;
  const std::vector<std::string> names = reader.channels();
  Image image(reader.width(), reader.height(), 3);
  for (std::size_t c = 0; c < std::min<std::size_t>(names.size(), 3); ++c) {
    targets.push_back({names[c], &image, static_cast<int>(c)});
  }
  reader.read(targets);
}

class ExrLimits : public testing::Test {
 protected:
  void write(const std::string& bytes) const { std::ofstream(file, std::ios::binary) << bytes; }

  test::TemporaryDirectory directory;
  std::filesystem::path file = directory.path() / "a.exr";
};

// The headers claim what fills memory or time, and the file has some hundred bytes.
TEST_F(ExrLimits, AHeaderThatClaimsTooMuchIsRefusedBeforeMemoryIsAllocated) {
  struct Claim {
    const char* name;
    std::function<void(std::string&)> change;
    std::initializer_list<std::string_view> error;
    int tile = 0;
  };
  const auto window = [](const char* name, std::array<std::int32_t, 4> corners) {
    return [=](std::string& bytes) { setNumber(bytes, find(bytes, name).value, corners); };
  };
  const auto set = [](const char* name, std::size_t offset, std::uint32_t number) {
    return [=](std::string& bytes) { setNumber(bytes, find(bytes, name).value + offset, number); };
  };
  const auto resize = [](const char* name, std::uint32_t size) {
    return [=](std::string& bytes) { setNumber(bytes, find(bytes, name).size, size); };
  };
  const Claim claims[] = {
      {"height of 2^31", window("dataWindow", {0, -1073741824, 0, 1073741823}), {"2147483648 pixels along", "16384"}},
      {"width of 2^32",
       window("dataWindow", {-2147483647 - 1, 0, 2147483647, 0}),
       {"4294967296 pixels along", "16384"}},
      {"area", window("dataWindow", {0, 0, 16383, 16383}), {"268435456 pixels in a window", "67108864"}},
      {"display", window("displayWindow", {0, 0, 0, 16384}), {"16385 pixels along", "16384"}},
      {"far away",
       window("dataWindow", {1 << 30, 0, (1 << 30) + 5, 3}),
       {"1073741824 pixels from the origin", "1048576"}},
      {"no pixels", window("dataWindow", {0, 0, -1, 3}), {"has no pixels"}},
      {"table of blocks", window("dataWindow", {0, 0, 0, 16383}), {"tables of blocks take 8192 bytes"}},
      {"table of tiles",
       [](std::string& bytes) {
         setNumber(bytes, find(bytes, "tiles").value, std::array<std::uint32_t, 2>{1, 1});
       },
       {"tables of blocks take 192 bytes"},
       16},
      {"tile", set("tiles", 4, 1U << 31U), {"2147483648 pixels along", "tile"}, 16},
      {"memory of a tile",
       [](std::string& bytes) {
         setNumber(bytes, find(bytes, "tiles").value, std::array<std::uint32_t, 2>{16384, 16384});
       },
       {"1610612736 bytes in a block", "536870912"},
       16},
      {"attribute", resize("preview", 0x7fffffff), {"2147483647 bytes in an attribute", "16777216"}},
      {"attribute beyond the file", resize("numbers", 1 << 20), {"ends within the attribute numbers"}},
      {"preview", set("preview", 0, 16000), {"preview", "of 64008"}},
      {"text", set("words", 0, 1000), {"too short"}},
      {"size of a type", resize("dataWindow", 15), {"dataWindow", "15 bytes instead of 16"}},
      {"sampling", set("channels", 2 + 8, 0), {"sampling below 1"}},
      {"compression", [](std::string& bytes) { bytes[find(bytes, "compression").value] = 77; }, {"compression 77"}},
  };
  for (const Claim& claim : claims) {
    SCOPED_TRACE(claim.name);
    std::string bytes =
        test::exrBytes({.parts = {ExrPart{.channels = {"B", "G", "R"}, .tile = claim.tile}}, .manyAttributes = true});
    claim.change(bytes);
    write(bytes);
    test::takeLargestRequest();
    fg::test::expectError<InputError>([&] { readWhole(file); }, claim.error);
    EXPECT_LT(test::takeLargestRequest(), 1U << 17U);
  }
}

// The file of a public report: no display window, and a data window of 1 x 2^31 pixels.
TEST_F(ExrLimits, AFileOf85BytesWithAHugeWindowIsRefusedAtOnce) {
  const auto text = [](const char* literal, std::size_t size) { return std::string(literal, size); };
  std::string bytes = text("v/1\1\2\0\0\0", 8);
  bytes += text("channels\0chlist\0\x13\0\0\0", 20) + text("c\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0\0", 19);
  bytes += text("dataWindow\0box2i\0\x10\0\0\0", 21);
  for (const std::int32_t corner : {0, -1073741824, 0, 1073741823}) {
    bytes.append(reinterpret_cast<const char*>(&corner), sizeof corner);
  }
  bytes += '\0';
  EXPECT_EQ(bytes.size(), 85U);
  write(bytes);
  EXPECT_FALSE(isCompleteExr(file));
  test::takeLargestRequest();
  fg::test::expectError<InputError>([&] { readWhole(file); }, {"a.exr", "2147483648 pixels", "16384"});
  EXPECT_LT(test::takeLargestRequest(), 1U << 17U);
}

TEST_F(ExrLimits, PartsAndChannelsAreCounted) {
  ExrPart many{.channels = {}, .data = {{0, 0}, {0, 0}}};
  for (int i = 0; i <= kMostChannels.most; ++i) many.channels.push_back("c" + std::to_string(i));
  write(test::exrBytes({.parts = {many}, .display = {{0, 0}, {0, 0}}}));
  fg::test::expectError<InputError>([&] { readWhole(file); }, {"4097 channels", "4096"});

  test::ExrFileWish wish{.parts = {}, .display = {{0, 0}, {0, 0}}};
  for (int i = 0; i <= kMostParts.most; ++i) {
    wish.parts.push_back({.channels = {"Y"}, .data = {{0, 0}, {0, 0}}, .name = std::to_string(i)});
  }
  write(test::exrBytes(wish));
  fg::test::expectError<InputError>([&] { readWhole(file); }, {"1025 parts", "1024"});
}

TEST(ExrLimitsTable, IsThatOfTheManual) {
  test::checkTableOfLimits(kExrLimits, "samples/docs/sequences.md", "Limits of OpenEXR files");
}

/// Files of all kinds that are read.
std::vector<std::string> seeds() {
  using Box = Imath::Box2i;
  std::vector<std::string> files;
  for (int compression = 0; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
    const ExrPart part{.channels = {"B", "G", "R"}, .compression = static_cast<Imf::Compression>(compression)};
    files.push_back(test::exrBytes({.parts = {part}, .manyAttributes = true}));
    files.push_back(
        test::exrBytes({.parts = {ExrPart{.channels = {"Z"}, .compression = part.compression, .tile = 4}}}));
  }
  files.push_back(test::exrBytes(
      {.parts = {ExrPart{.channels = {"L.left.R", "R"}, .data = Box{{-3, 2}, {2, 7}}}}, .views = {"left", "right"}}));
  files.push_back(test::exrBytes({.parts = {ExrPart{.channels = {"R"}, .name = "a-left", .view = "left"},
                                            ExrPart{.channels = {"X.Y"}, .name = "b", .view = "right", .tile = 2}}}));
  return files;
}

/// Changes a file at random: mostly what its headers say, else any byte.
std::string changed(std::string bytes, std::mt19937_64& random) {
  const auto below = [&](std::size_t bound) { return test::below(random, bound); };
  constexpr std::uint32_t kNumbers[] = {
      0,          1,          2,          3,          7,          255,        256,        4096,       16383,     16384,
      0x00ffffff, 0x3fffffff, 0x40000000, 0x7ffffffe, 0x7fffffff, 0x80000000, 0xc0000000, 0xfffffffe, 0xffffffff};
  const auto someNumber = [&] {
    return below(4) == 0 ? static_cast<std::uint32_t>(random()) : kNumbers[below(std::size(kNumbers))];
  };
  const std::vector<Place> places = attributesOf(bytes);
  std::vector<Place> added;
  for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
    const Place& place = places[below(places.size())];
    switch (below(8)) {
      case 0:
      case 1:
      case 2:  // A number in a value.
        if (place.end >= place.value + 4) {
          setNumber(bytes, place.value + below(place.end - place.value - 3), someNumber());
        }
        break;
      case 3:
        setNumber(bytes, place.size, someNumber());
        break;
      case 4:  // Names and types; the zero byte at their end, too.
        bytes[place.name + below(place.size - place.name)] = static_cast<char>(random());
        break;
      case 5:
        bytes[4 + below(4)] = static_cast<char>(random());
        break;
      case 6:  // What follows the header: other headers, tables and blocks.
        bytes[places.back().end + below(bytes.size() - places.back().end)] = static_cast<char>(random());
        break;
      default:
        added.push_back(place);
    }
  }
  // These move the attributes, so they come last.
  if (!added.empty())
    bytes.insert(places.front().name, bytes.substr(added.front().name, added.front().end - added.front().name));
  if (below(8) == 0) bytes.resize(below(bytes.size()));
  return bytes;
}

TEST_F(ExrLimits, DamagedFilesNeitherCrashNorHangNorFillMemory) {
  const std::vector<std::string> whole = seeds();
  test::tryDamagedFiles(
      {.read =
           [&](std::mt19937_64& random, std::uint64_t seed) {
             write(changed(whole[seed % whole.size()], random));
             try {
               readWhole(file);
               return true;
             } catch (const InputError& error) {
               EXPECT_NE(std::string(error.what()).find("a.exr"), std::string::npos) << error.what();
               return false;
             }
           },
       // An image of three components with as many pixels as a window may have, and the largest block.
       .largestRequest = std::size_t{3 * 4} * kMostPixels.most});
}

}  // namespace
}  // namespace walr
