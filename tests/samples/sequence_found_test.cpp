// Sequences as renderers and other systems leave them.
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/sequence/sequence.h"
#include "tests/error_text.h"
#include "tests/samples/exr_files.h"
#include "tests/samples/sequence_fixture.h"

namespace walr {
namespace {

namespace fs = std::filesystem;

class FoundSequence : public test::SequenceFixture {};

TEST_F(FoundSequence, UpperCaseNamesAreFramesAndHiddenFilesAreNot) {
  files.write(0, 1);
  fs::rename(files.frameFile(1), directory.path() / "noisy_0001.EXR");
  std::ofstream(directory.path() / "._noisy_0000.exr") << "Mac OS X";
  EXPECT_EQ(open().entries().size(), 2U);
}

// Houdini and Maya render frames before 0. Read without the sign, they would run backwards.
TEST_F(FoundSequence, NegativeFrameNumbersAreRefused) {
  files.write(1, 1);
  for (const char* name : {"shot.-0001.exr", "shot_-001.exr", "-1.exr", "shot -1.exr"}) {
    fs::rename(files.frameFile(1), directory.path() / name);
    expectRefused({name, "negative frame number"});
    fs::rename(directory.path() / name, files.frameFile(1));
  }
  fs::rename(files.frameFile(1), directory.path() / "shot-0001.exr");
  EXPECT_EQ(open().entries()[0].number, 1);
}

// OpenEXR's Python module writes doubles, and OpenImageIO what it is given.
TEST_F(FoundSequence, AttributesOfAnotherTypeAreNamed) {
  const fs::path file = directory.path() / "f0.exr";
  const auto write = [&](const std::function<void(Imf::Header&)>& add) {
    Imf::Header header(1, 1);
    add(header);
    for (const char* name : {"worldToCamera", "previousWorldToCamera", "cameraToClip"}) {
      if (header.find(name) == header.end()) header.insert(name, Imf::M44fAttribute(Imath::M44f()));
    }
    header.channels().insert("A", Imf::Channel(Imf::HALF));
    Imf::OutputFile(file.c_str(), header);  // No pixels are read.
  };
  const struct {
    std::function<void(Imf::Header&)> add;
    std::initializer_list<std::string_view> parts;
    std::function<void(const ExrReader&)> read;
  } cases[] = {
      {[](auto& h) { h.insert("worldToCamera", Imf::M44dAttribute(Imath::M44d())); },
       {"f0.exr", "worldToCamera", "m44d", "m44f"},
       [](const auto& f) { static_cast<void>(f.matrix("worldToCamera")); }},
      {[](auto& h) {
         h.insert("jitter", Imf::V2dAttribute({0.25, 0.25}));
       },
       {"jitter", "v2d", "v2f"},
       [](const auto& f) { static_cast<void>(f.vector("jitter")); }},
      {[](auto& h) { h.insert("cameraCut", Imf::FloatAttribute(1.0F)); },
       {"cameraCut", "float", "int"},
       [](const auto& f) { static_cast<void>(f.integer("cameraCut")); }},
  };
  for (const auto& wrong : cases) {
    write(wrong.add);
    const ExrReader reader(file);
    fg::test::expectError<InputError>([&] { wrong.read(reader); }, wrong.parts);
    EXPECT_FALSE(reader.integer("absent").has_value());
  }
}

// PBRT calls albedo as walr does, and everything else otherwise.
TEST_F(FoundSequence, AMissingChannelIsToldWithThoseFoundAndTheWayOut) {
  std::ofstream(directory.path() / "f0.exr", std::ios::binary)
      << test::exrBytes({.parts = {{.channels = {"Albedo.B", "Albedo.G", "Albedo.R", "B", "G", "Ns.X", "R"}}}});
  expectRefused({"missing channels Indirect.R", "--channels FILE", "Channels found: Albedo.B, ", "Ns.X, R"});
}

// tinyexr writes channels in the order that it is given; OpenEXR would read the pixels of one as those of another.
TEST_F(FoundSequence, ChannelsThatAreNotSortedAreRefused) {
  const std::string sorted = test::exrBytes({.parts = {{.channels = {"A", "B"}}}});
  const std::size_t first = sorted.find("chlist") + 11;  // After a zero and the size.
  constexpr std::size_t kEntry = 18;
  ASSERT_EQ(sorted[first + kEntry], 'B');
  for (const char* const names : {"BA", "AA"}) {
    std::string bytes = sorted;
    bytes[first] = names[0];
    bytes[first + kEntry] = names[1];
    std::ofstream(directory.path() / "f0.exr", std::ios::binary) << bytes;
    expectRefused({"f0.exr", "alphabetical order", names[0] == 'B' ? "(B, A)" : "(A, A)"});
  }
}

}  // namespace
}  // namespace walr
