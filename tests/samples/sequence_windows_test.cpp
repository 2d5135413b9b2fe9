// Frames that are a part of the picture or reach beyond it, and frames of one eye or of other renderers. The files are
// those of `exrBytes`, so that every value tells its pixel and its channel.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/image/half.h"
#include "samples/sequence/cameras.h"
#include "samples/sequence/sequence.h"
#include "tests/error_text.h"
#include "tests/samples/exr_files.h"
#include "tests/samples/sequence_fixture.h"

namespace walr {
namespace {

using test::ExrPart;
using test::valueAt;
using Box = Imath::Box2i;

/// The channels of Cycles' layout that are always read, sorted as files have them.
std::vector<std::string> cyclesChannels(const std::string& view = {}) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& plane, const std::string& letters) {
    for (const char letter : letters) names.push_back(plane + "." + (view.empty() ? "" : view + ".") + letter);
  };
  add("Depth", "Z");
  add("DiffCol", "BGR");
  add("DiffInd", "BGR");
  add("Normal", "XYZ");
  add("Vector", "XY");
  return names;
}
constexpr int kDepth = 0;    ///< Number of Depth.Z in that list.
constexpr int kAlbedoB = 1;  ///< Of DiffCol.B.
constexpr int kLightB = 4;   ///< Of DiffInd.B.

class SequenceWindows : public test::SequenceFixture {
 protected:
  SequenceWindows() : SequenceFixture(8, 6) {}

  void write(const std::string& name, const Box& data, const Box& display) const {
    writeFile(name, {.parts = {ExrPart{.channels = cyclesChannels(), .data = data}}, .display = display});
  }
  void writeFile(const std::string& name, const test::ExrFileWish& wish) const {
    std::ofstream(directory.path() / name, std::ios::binary) << test::exrBytes(wish);
  }
  [[nodiscard]] std::filesystem::path writeMap(const std::string& json) const {
    test::writeText(directory.path() / "map.json", json);
    return directory.path() / "map.json";
  }
};

/// Where a frame's camera sees a point of view space, in pixels of the frame's images.
glm::vec2 seenAt(const Frame& frame, glm::vec3 point) {
  const glm::vec4 clip = frame.camera.projection * glm::vec4(point, 1.0F);
  return {(clip.x / clip.w + 1.0F) * 0.5F * static_cast<float>(frame.depth.width()),
          (1.0F - clip.y / clip.w) * 0.5F * static_cast<float>(frame.depth.height())};
}

TEST_F(SequenceWindows, MovingCropsAreReadAtTheirPlace) {
  files.writeCameras(0, 1);
  const Box display{{0, 0}, {7, 5}};
  write("f0.exr", {{2, 1}, {5, 3}}, display);
  write("f1.exr", {{3, 0}, {7, 2}}, display);
  const Sequence sequence = open();
  EXPECT_EQ(sequence.place(), (PixelRect{{2, 0}, {6, 4}}));
  for (const std::size_t index : {0U, 1U}) {
    const Frame frame = sequence.read(index);
    ASSERT_EQ(frame.depth.width(), 6);
    for (int y = 0; y < 4; ++y) {
      for (int x = 2; x < 8; ++x) {
        SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
        const bool inside = index == 0 ? x < 6 && y > 0 : x > 2 && y < 3;
        EXPECT_EQ(frame.indirect.at(x - 2, y, 2), inside ? valueAt(x, y, kLightB) : 0.0F);
        EXPECT_EQ(frame.albedo.at(x - 2, y, 2), inside ? valueAt(x, y, kAlbedoB) : 0.0F);
        EXPECT_EQ(frame.depth.at(x - 2, y, 0), inside ? valueAt(x, y, kDepth) : kBackgroundDepth);
        EXPECT_EQ(frame.normal.at(x - 2, y, 2) == 0.0F, !inside);
      }
    }
  }
  EXPECT_EQ(sequence.read(1).place->data, (PixelRect{{3, 0}, {5, 3}}));
  EXPECT_EQ(sequence.read(1).place->display, (PixelRect{{0, 0}, {8, 6}}));
}

// The camera's focal lengths are 1: (0.5, 0.25, -1) is at (0.5, 0.25) of clip space, pixel (6, 2.25) of 8 x 6.
TEST_F(SequenceWindows, TheCameraBelongsToTheDisplayWindow) {
  files.writeCameras(0, 0);
  struct Case {
    const char* name;
    Box data;
    Box display;
    glm::vec2 seen;
  };
  const Case cases[] = {
      {"whole", {{0, 0}, {7, 5}}, {{0, 0}, {7, 5}}, {6.0F, 2.25F}},
      {"crop", {{2, 1}, {5, 3}}, {{0, 0}, {7, 5}}, {4.0F, 1.25F}},
      {"overscan", {{-2, -3}, {9, 6}}, {{0, 0}, {7, 5}}, {8.0F, 5.25F}},
      {"display window elsewhere", {{100, 50}, {107, 55}}, {{98, 51}, {105, 56}}, {4.0F, 3.25F}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    write("f0.exr", c.data, c.display);
    const glm::vec2 seen = seenAt(open().read(0), {0.5F, 0.25F, -1.0F});
    EXPECT_NEAR(seen.x, c.seen.x, 1e-4F);
    EXPECT_NEAR(seen.y, c.seen.y, 1e-4F);
  }
}

TEST_F(SequenceWindows, ReferencesMayHaveOtherDataWindows) {
  files.writeCameras(0, 0);
  const Box display{{0, 0}, {7, 5}};
  write("f0.exr", {{2, 1}, {5, 3}}, display);
  write("ref0.exr", {{3, 0}, {7, 5}}, display);
  const Frame frame = open().read(0);
  EXPECT_EQ(frame.reference->indirect.at(1, 0, 2), valueAt(3, 1, kLightB));
  EXPECT_TRUE(std::isnan(frame.reference->indirect.at(0, 0, 2))) << "a pixel that the reference lacks";
  write("ref0.exr", display, {{0, 0}, {8, 5}});
  expectRefused({"ref0.exr", "display window", "9 x 6", "8 x 6"});
}

TEST_F(SequenceWindows, FramesOfDifferentPicturesAreRefused) {
  files.writeCameras(0, 1);
  write("f0.exr", {{0, 0}, {3, 3}}, {{0, 0}, {7, 5}});
  write("f1.exr", {{0, 0}, {3, 3}}, {{2, 0}, {9, 5}});
  expectRefused({"f1.exr", "8 x 6 pixels from (2, 0) on", "f0.exr", "data windows may differ"});
}

TEST_F(SequenceWindows, DataWindowsFarApartAreRefused) {
  files.writeCameras(0, 1);
  write("f0.exr", {{0, 0}, {3, 3}}, {{0, 0}, {7, 5}});
  write("f1.exr", {{100000, 0}, {100003, 3}}, {{0, 0}, {7, 5}});
  expectRefused({"100004 x 4", "16384", "--frames"});
}

// Sparse light counts from the corner of the data window: its pixel (1, 0) is (4, 1) of the picture.
TEST_F(SequenceWindows, SparseLightKeepsItsPixels) {
  const Image image(4, 2, 1);
  const glm::mat4 matrix(1.0F);
  std::vector<ExrChannel> channels;
  for (const char* const name : {"Indirect.R", "Indirect.G", "Indirect.B", "Albedo.R", "Albedo.G", "Albedo.B",
                                 "Normal.X", "Normal.Y", "Normal.Z", "Depth.Z", "Motion.X", "Motion.Y", "Motion.Z"}) {
    channels.push_back({name, &image, 0, ExrType::Half});
  }
  const auto writeAt = [&](const char* name, glm::ivec2 corner) {
    const ImagePlace place{{corner, {4, 2}}, {corner, {4, 2}}, {{0, 0}, {8, 6}}};
    writeExr(directory.path() / name, channels,
             std::vector<ExrAttribute>{{kViewAttribute, matrix},
                                       {kPreviousViewAttribute, matrix},
                                       {kProjectionAttribute, matrix},
                                       {kLightGroupAttribute, glm::vec2(2.0F)},
                                       {kLightOffsetAttribute, glm::vec2(1.0F, 0.0F)}},
             place);
  };
  writeAt("f0.exr", {0, 0});
  writeAt("f1.exr", {3, 1});
  const Sequence sequence = open();
  EXPECT_EQ(sequence.entries()[0].lightOffset, glm::ivec2(1, 0));
  EXPECT_EQ(sequence.entries()[1].lightOffset, glm::ivec2(0, 1));
}

TEST_F(SequenceWindows, OneViewOfAStereoPictureIsChosen) {
  files.writeCameras(0, 0);
  std::vector<std::string> both = cyclesChannels("left");
  for (const std::string& name : cyclesChannels("right")) both.push_back(name);
  writeFile("f0.exr", {.parts = {ExrPart{.channels = both}}, .views = {"left", "right"}});
  expectRefused({"f0.exr", "left, right", "--stereo-view"});
  SequenceOptions options;
  options.stereoView = "right";
  const int first = static_cast<int>(cyclesChannels().size());
  EXPECT_EQ(open(options).read(0).indirect.at(2, 1, 2), valueAt(2, 1, first + kLightB));
  options.stereoView = "middle";
  expectRefused({"f0.exr", "middle", "left, right"}, options);
}

// Each pass in a part of its own, as Blender 5 writes them.
TEST_F(SequenceWindows, EveryPassMayHaveItsOwnPart) {
  files.writeCameras(0, 0);
  test::ExrFileWish wish{.parts = {}};
  for (const std::string& name : cyclesChannels()) {
    const std::string pass = "ViewLayer." + name.substr(0, name.find('.'));
    if (wish.parts.empty() || wish.parts.back().name != pass) wish.parts.push_back({.channels = {}, .name = pass});
    wish.parts.back().channels.push_back("ViewLayer." + name);
  }
  writeFile("f0.exr", wish);
  const Sequence sequence = open();
  EXPECT_EQ(sequence.layout().viewLayer, "ViewLayer");
  EXPECT_EQ(sequence.read(0).indirect.at(3, 1, 2), valueAt(3, 1, 0)) << "DiffInd.B is the first channel of its part";
}

constexpr const char* kMap = R"({
  "channels": {
    "Indirect": ["diffuse_indirect.R", "diffuse_indirect.G", "diffuse_indirect.B"],
    "Albedo": ["diffuse_albedo.R", "diffuse_albedo.G", "diffuse_albedo.B"],
    "Normal": ["N.X", "N.Y", "N.Z"],
    "Depth": ["Z"],
    "Motion": ["motionvector.R", "motionvector.G"]
  },
  "light": "times albedo", "normals": "world", "depth": "distance", "motionScale": [1, -1]
})";

const std::vector<std::string>& mappedChannels() {
  static const std::vector<std::string> names{"Z",
                                              "diffuse_albedo.B",
                                              "diffuse_albedo.G",
                                              "diffuse_albedo.R",
                                              "diffuse_indirect.B",
                                              "diffuse_indirect.G",
                                              "diffuse_indirect.R",
                                              "N.X",
                                              "N.Y",
                                              "N.Z",
                                              "motionvector.R",
                                              "motionvector.G"};
  return names;
}

// The pixel at the right is at a slope of 0.75, so that its distance of 1.25 is a depth of 1.
TEST_F(SequenceWindows, AMapSaysWhichChannelsHoldWhat) {
  files.writeCameras(0, 0);
  const Box window{{0, 0}, {3, 0}};
  writeFile("f0.exr", {.parts = {ExrPart{.channels = mappedChannels(), .data = window}}, .display = window});
  expectRefused({"f0.exr", "--channels FILE", "diffuse_indirect.R"});
  SequenceOptions options;
  options.channelMap = writeMap(kMap);
  const Sequence sequence = open(options);
  EXPECT_EQ(sequence.denoiserLayout().motionScale, glm::vec2(1.0F, -1.0F));
  EXPECT_EQ(sequence.denoiserLayout().conventions.normal, InputConventions::Space::World);
  EXPECT_EQ(sequence.denoiserLayout().conventions.motionDepth, InputConventions::MotionDepth::StaticScene);
  const Frame frame = sequence.read(0);
  EXPECT_EQ(frame.albedo.at(3, 0, 0), valueAt(3, 0, 3));
  EXPECT_EQ(frame.indirect.at(3, 0, 0), valueAt(3, 0, 6) / valueAt(3, 0, 3));
  EXPECT_EQ(frame.normal.at(3, 0, 0), valueAt(3, 0, 7));
  EXPECT_EQ(frame.motion.at(3, 0, 1), valueAt(3, 0, 11));
  EXPECT_NEAR(frame.depth.at(3, 0, 0), valueAt(3, 0, 0) / 1.25F, 1e-6F);
}

/// The map with specular light, which is in these channels.
constexpr std::array kSpecularChannels{"s.R", "s.G", "s.B", "c.R", "c.G", "c.B", "d.Z", "r.Y", "m.X", "m.Y", "m.Z"};
std::string mapWithSpecularLight() {
  std::string json = kMap;
  json.insert(json.find("\"Indirect\""), R"("Specular": ["s.R", "s.G", "s.B"], "SpecularAlbedo": ["c.R", "c.G", "c.B"],
    "SpecularDistance": ["d.Z"], "Roughness": ["r.Y"], "SpecularMotion": ["m.X", "m.Y", "m.Z"], )");
  return json;
}

// Lights times albedo are divided by their own albedos; a composite adds specular light as the file has it.
TEST_F(SequenceWindows, AMapFindsSpecularLight) {
  files.writeCameras(0, 0);
  std::string json = mapWithSpecularLight();
  SequenceOptions options;
  options.channelMap = writeMap(json);
  std::vector<std::string> channels = mappedChannels();
  const int first = static_cast<int>(channels.size());
  channels.insert(channels.end(), kSpecularChannels.begin(), kSpecularChannels.end());
  writeFile("f0.exr", {.parts = {ExrPart{.channels = channels}}});
  writeFile("ref_f0.exr", {.parts = {ExrPart{.channels = channels}}});

  options.light = {.indirect = false, .specular = SpecularWish::Denoised};
  const auto valueOf = [](int channel) { return static_cast<float>(toHalf(valueAt(3, 1, channel))); };
  const Frame frame = open(options).read(0);
  const float light = valueOf(first) / valueOf(first + 3);
  EXPECT_EQ(frame.specular.at(3, 1, 0), light);
  EXPECT_EQ(frame.reference->specular.at(3, 1, 0), light);
  EXPECT_EQ(frame.specularAlbedo.at(3, 1, 2), valueOf(first + 5));
  EXPECT_EQ(frame.specularDistance.at(3, 1, 0), valueOf(first + 6));
  EXPECT_EQ(frame.roughness.at(3, 1, 0), valueOf(first + 7));
  for (const int component : {0, 1, 2})
    EXPECT_EQ(frame.specularMotion.at(3, 1, component), valueOf(first + 8 + component));

  json.replace(json.find("times albedo"), 5, "without");
  // A channel of the file may stand for several: those of a grey light for one.
  json.insert(json.find("\"Motion\""), R"("Direct": ["s.R", "s.R", "s.R"], "Emission": ["c.R", "c.G", "c.B"], )");
  options.channelMap = writeMap(json);
  options.light = kWholePicture;
  const Frame whole = open(options).read(0);
  EXPECT_EQ(whole.nonDiffuse.at(3, 1, 1), valueOf(first + 1) * valueOf(first + 4));
  EXPECT_EQ(whole.nonDiffuse.at(3, 1, 0), valueOf(first) * valueOf(first + 3));
  for (const int component : {0, 1, 2}) EXPECT_EQ(whole.direct.at(3, 1, component), valueOf(first));

  // The same where the images of all frames are larger than the file's.
  files.writeCameras(0, 1);
  writeFile("f1.exr", {.parts = {ExrPart{.channels = channels, .data = Box({-1, -1}, {5, 3})}}});
  const Frame larger = open(options).read(0);
  for (const int component : {0, 1, 2}) EXPECT_EQ(larger.direct.at(4, 2, component), valueOf(first));
}

// A half without its whole is no reference.
TEST_F(SequenceWindows, AReferenceMayLackSpecularLight) {
  files.writeCameras(0, 0);
  const std::string json = mapWithSpecularLight();
  std::vector<std::string> channels = mappedChannels();
  for (const char* const name : {"SpecularA.R", "SpecularA.G", "SpecularA.B"}) channels.emplace_back(name);
  writeFile("ref_f0.exr", {.parts = {ExrPart{.channels = channels}}});
  channels.insert(channels.end(), kSpecularChannels.begin(), kSpecularChannels.end());
  writeFile("f0.exr", {.parts = {ExrPart{.channels = channels}}});
  SequenceOptions options;
  options.channelMap = writeMap(json);
  options.light.specular = SpecularWish::Denoised;
  const Frame frame = open(options).read(0);
  EXPECT_TRUE(frame.reference->specular.empty() && frame.reference->specularHalf.empty());
  // Checked before any frame is read.
  std::erase(channels, "diffuse_albedo.G");
  writeFile("ref_f0.exr", {.parts = {ExrPart{.channels = channels}}});
  expectRefused({"ref_f0.exr", "diffuse_albedo.G"}, options);
}

TEST_F(SequenceWindows, WrongMapsAreNamed) {
  files.writeCameras(0, 0);
  writeFile("f0.exr", {.parts = {ExrPart{.channels = mappedChannels()}}});
  SequenceOptions options;
  const auto expectBad = [&](const std::string& from, const std::string& to,
                             std::initializer_list<std::string_view> parts) {
    std::string json = kMap;
    json.replace(json.find(from), from.size(), to);
    options.channelMap = writeMap(json);
    SCOPED_TRACE(json);
    expectRefused(parts, options);
  };
  expectBad("[\"Z\"]", "[\"depth.Z\"]", {"f0.exr", "missing channel depth.Z", "Channels found", "diffuse_albedo.B"});
  expectBad("[\"Z\"]", "\"Z\"", {"map.json", "\"Depth\"", "array of 1 names"});
  expectBad("[\"motionvector.R\", ", "[", {"map.json", "\"Motion\"", "2 or 3"});
  expectBad("\"Depth\"", R"("Roughness": ["Z"], "Depth")", {"map.json", "\"Specular\"", "\"SpecularAlbedo\""});
  expectBad("\"Depth\"", "\"Deep\"", {"map.json", "\"Deep\"", "ObjectId"});
  expectBad("\"world\"", "\"object\"", {"map.json", "\"normals\"", "\"view\" or \"world\""});
  expectBad("\"Depth\"", R"("ObjectId": ["Typo.Y"], "Depth")", {"f0.exr", "missing channel Typo.Y"});
  expectBad("[1, -1]", "[1]", {"map.json", "\"motionScale\"", "2 numbers"});
  expectBad("\"channels\"", "\"passes\"", {"map.json", "\"channels\""});
  expectBad("{", "", {"map.json", "JSON"});
  options.channelMap = writeMap(kMap);
  options.viewLayer = "ViewLayer";
  expectRefused({"map.json", "'ViewLayer'", "either --channels or --view-layer"}, options);
  options.viewLayer.clear();
  options.channelMap = "/nowhere.json";
  expectRefused({"/nowhere.json"}, options);
}

// Where a reference ends, its albedo does, too.
TEST_F(SequenceWindows, AReferenceTimesAlbedoMayHaveAnotherDataWindow) {
  files.writeCameras(0, 0);
  writeFile("f0.exr", {.parts = {ExrPart{.channels = mappedChannels()}}});
  writeFile("ref_f0.exr", {.parts = {ExrPart{.channels = mappedChannels(), .data = Box({1, 0}, {3, 1})}}});
  SequenceOptions options;
  options.channelMap = writeMap(kMap);
  const Frame frame = open(options).read(0);
  EXPECT_TRUE(std::isnan(frame.reference->indirect.at(0, 1, 0)));
  EXPECT_FALSE(std::isnan(frame.reference->indirect.at(1, 1, 0)));
}

}  // namespace
}  // namespace walr
