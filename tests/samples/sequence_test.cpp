#include "samples/sequence/sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/sequence/cameras.h"
#include "samples/sequence/writer.h"
#include "tests/error_text.h"
#include "tests/samples/sequence_fixture.h"
#include "tests/shared_data.h"

namespace walr {
namespace {

using test::addColours;
using test::Channels;
using test::SyntheticSequence;

class SequenceTest : public test::SequenceFixture {
 protected:
  void editCameras(const std::function<void(nlohmann::json&)>& edit) const {
    const auto path = files.folder() / "cameras.json";
    auto document = nlohmann::json::parse(test::readText(path));
    edit(document["frames"]);
    test::writeText(path, document.dump());
  }
};

TEST_F(SequenceTest, ReadsBlenderFramesUnchanged) {
  files.write(3, 5);
  const Sequence sequence = open();
  EXPECT_EQ(sequence.layout().layout, &cyclesLayout());
  EXPECT_EQ(sequence.extent(), (fg::Extent{6, 4}));
  ASSERT_EQ(sequence.entries().size(), 3U);
  EXPECT_TRUE(sequence.hasReferences());
  const Frame frame = sequence.read(1);
  EXPECT_EQ(frame.number, 4);
  EXPECT_EQ(frame.normal.at(2, 2, 2), 1.0F);
  EXPECT_EQ(frame.depth.at(2, 0, 0), kBackgroundDepth);
  EXPECT_EQ(frame.albedo.at(2, 2, 1), 0.8F);
  EXPECT_EQ(frame.motion.components(), 3);
  EXPECT_EQ(frame.reference->indirect.at(2, 2, 0), 0.5F);
  EXPECT_TRUE(frame.direct.empty());
  EXPECT_FALSE(frame.resetHistory);
  EXPECT_TRUE(sequence.read(0).resetHistory);
}

// Blender's vectors point to the previous position, with y up. The camera moves to the right and up past a still wall,
// so the cameras tell where a point of the wall lay in the previous frame.
TEST_F(SequenceTest, MotionOfBlenderLeadsToThePreviousPlace) {
  files.write(0, 1);
  editCameras([](nlohmann::json& frames) {
    frames[1]["view"][12] = -1.0;
    frames[1]["view"][13] = -3.0;
  });
  // The camera moved by 1 and 3 units. A picture of 6 x 4 pixels shows 8 x 8 units of the wall.
  files.writeFrame(1, [](Channels& channels) {
    std::ranges::fill(channels["Vector.X"].values(), 0.75F);
    std::ranges::fill(channels["Vector.Y"].values(), 1.5F);
  });
  const Sequence sequence = open();
  const Frame frame = sequence.read(1);
  const Camera& camera = frame.camera;
  const auto pixelOf = [&](const glm::vec4& viewPosition) {
    const glm::vec4 clip = camera.projection * viewPosition;
    return glm::vec2(0.5F + 0.5F * clip.x / clip.w, 0.5F - 0.5F * clip.y / clip.w) * glm::vec2(6.0F, 4.0F);
  };
  const glm::vec4 place(0.5F, -0.25F, -4.0F, 1.0F);
  const glm::vec2 moved = pixelOf(camera.previousView * glm::inverse(camera.view) * place) - pixelOf(place);
  const glm::vec2 motion =
      glm::vec2(frame.motion.at(2, 2, 0), frame.motion.at(2, 2, 1)) * sequence.layout().layout->motionScale;
  // Rounding of single precision.
  EXPECT_NEAR(motion.x, moved.x, 1e-5F);
  EXPECT_NEAR(motion.y, moved.y, 1e-5F);
}

TEST_F(SequenceTest, AcceptsAViewLayerPrefix) {
  files.write(0, 0);
  const auto prefixed = [](const std::string& prefix) {
    return [prefix](Channels& channels) {
      Channels renamed;
      for (auto& [name, image] : channels) {
        renamed[prefix + name] = image;
      }
      channels = std::move(renamed);
    };
  };
  files.writeFrame(0, prefixed("View Layer.001."));
  files.writeReference(0, prefixed("View Layer.001."));
  const Sequence sequence = open();
  EXPECT_EQ(sequence.layout().viewLayer, "View Layer.001");
  EXPECT_EQ(sequence.read(0).albedo.at(2, 2, 1), 0.8F);
}

TEST_F(SequenceTest, SeveralViewLayersRequireAChoice) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) {
    for (const auto& [name, image] : Channels(channels)) {
      channels["Second." + name] = image;
      channels["First." + name] = image;
      channels.erase(name);
    }
  });
  std::filesystem::remove(directory.path() / "ref_0000.exr");
  expectRefused({"First, Second", "--view-layer"});
  SequenceOptions options;
  options.viewLayer = "Second";
  EXPECT_EQ(open(options).layout().viewLayer, "Second");
  options.viewLayer = "Third";
  expectRefused({"Third", "First, Second"}, options);
}

TEST_F(SequenceTest, TheProjectsOwnLayoutRoundTrips) {
  Frame written = test::projectFrame(7, 6, 4);
  written.camera.view[3][0] = 0.5F;
  written.camera.previousView[3][0] = 0.25F;
  written.camera.jitter = {0.125F, -0.375F};
  written.motion.at(1, 2, 2) = -0.5F;
  written.objectId = Image(6, 4, 1);
  written.objectId.at(1, 2, 0) = 7.0F;
  written.objectId.at(0, 0, 0) = -1.0F;
  written.specular = written.specularAlbedo = Image(6, 4, 3);
  written.specularDistance = written.roughness = Image(6, 4, 1);
  written.specular.at(2, 1, 0) = 3.0F;
  written.specularAlbedo.at(2, 1, 0) = 0.5F;
  written.specularDistance.at(2, 1, 0) = kBackgroundDepth;
  written.roughness.at(2, 1, 0) = 0.25F;
  written.specularMotion = Image(6, 4, 3);
  for (const int component : {0, 1, 2})
    written.specularMotion.at(2, 1, component) = 1e5F * float(component - 1) + 0.125F;
  writeFrame(directory.path(), written);
  Reference reference{.indirect = Image(6, 4, 3), .specular = Image(6, 4, 3), .specularHalf = Image(6, 4, 3)};
  reference.indirect.at(5, 3, 2) = 2.0F;
  reference.specular.at(5, 3, 1) = 4.0F;
  reference.specularHalf.at(5, 3, 0) = 5.0F;
  writeReference(directory.path(), 7, reference);

  SequenceOptions options;
  options.light = kWholePicture;
  options.light.specular = SpecularWish::IfHeld;
  const Sequence sequence = open(options);
  EXPECT_EQ(sequence.layout().layout, &projectLayout());
  const Frame read = sequence.read(0);
  EXPECT_EQ(read.camera.view, written.camera.view);
  EXPECT_EQ(read.camera.previousView, written.camera.previousView);
  EXPECT_EQ(read.camera.projection, written.camera.projection);
  EXPECT_EQ(read.camera.jitter, written.camera.jitter);
  EXPECT_EQ(read.motion.at(1, 2, 2), -0.5F);
  EXPECT_TRUE(std::ranges::equal(read.objectId.values(), written.objectId.values()));
  EXPECT_EQ(read.emission.at(0, 0, 0), 2.0F);
  EXPECT_TRUE(std::ranges::equal(read.indirect.values(), written.indirect.values()));
  EXPECT_TRUE(std::ranges::equal(read.depth.values(), written.depth.values()));
  EXPECT_EQ(read.reference->indirect.at(5, 3, 2), 2.0F);
  EXPECT_EQ(read.specular.at(2, 1, 0), 3.0F);
  EXPECT_EQ(read.specularAlbedo.at(2, 1, 0), 0.5F);
  EXPECT_EQ(read.specularDistance.at(2, 1, 0), kBackgroundDepth);
  EXPECT_EQ(read.roughness.at(2, 1, 0), 0.25F);
  EXPECT_TRUE(std::ranges::equal(read.specularMotion.values(), written.specularMotion.values()));
  EXPECT_EQ(read.reference->specular.at(5, 3, 1), 4.0F);
  EXPECT_EQ(read.reference->specularHalf.at(5, 3, 0), 5.0F);
  EXPECT_EQ(read.nonDiffuse.at(2, 1, 0), 3.0F * 0.5F);  // Composites add it.
  EXPECT_TRUE(open().read(0).specular.empty());
  EXPECT_TRUE(open().read(0).specularMotion.empty());
}

TEST_F(SequenceTest, TheMotionOfSpecularLightIsOptional) {
  SequenceOptions options;
  options.light.specular = SpecularWish::Denoised;
  const auto write = [&](int number, bool withMotion, float value = 0.0F) {
    Frame frame = test::projectFrame(number, 6, 4);
    frame.specular = frame.specularAlbedo = Image(6, 4, 3);
    frame.specularDistance = frame.roughness = Image(6, 4, 1);
    if (withMotion) frame.specularMotion = Image(6, 4, 3);
    if (withMotion) frame.specularMotion.at(2, 1, 1) = value;
    writeFrame(directory.path(), frame);
  };
  write(0, false);
  write(1, true);
  EXPECT_TRUE(open(options).read(1).specularMotion.empty());  // The first frame decides.
  EXPECT_FALSE(open(options).read(1).specular.empty());
  write(0, true);
  write(1, false);
  expectRefused({"noisy_0001.exr", "missing channels SpecularMotion.X, SpecularMotion.Y, SpecularMotion.Z"}, options);
  write(1, true, std::numeric_limits<float>::infinity());
  fg::test::expectError<InputError>([&] { static_cast<void>(open(options).read(1)); },
                                    {"noisy_0001.exr", "SpecularMotion.Y", "not finite", "(2, 1)"});
  options.nonFinite = NonFinitePolicy::Replace;
  EXPECT_EQ(open(options).read(1).nonFinite.size(), 1U);
}

TEST_F(SequenceTest, ReadsSparseLight) {
  for (const int number : {0, 1}) {
    Frame frame = test::projectFrame(number, 6, 4);
    frame.light = {.columns = 2, .rows = 3};
    frame.lightOffset = {number, 2};
    writeFrame(directory.path(), frame);
  }
  const Sequence sequence = open();
  EXPECT_EQ(sequence.denoiserLayout().conventions.light, (LightPattern{2, 3}));
  EXPECT_EQ(sequence.read(0).light, (LightPattern{2, 3}));
  EXPECT_EQ(sequence.read(1).lightOffset, glm::ivec2(1, 2));
}

TEST_F(SequenceTest, WrongSparseLightIsNamedWithItsFile) {
  const auto writeWith = [&](int number, LightPattern light, glm::ivec2 offset) {
    Frame frame = test::projectFrame(number, 6, 4);
    frame.light = light;
    frame.lightOffset = offset;
    writeFrame(directory.path(), frame);
  };
  writeWith(0, {2, 2}, {0, 0});
  writeWith(1, {2, 2}, {2, 0});
  expectRefused({"noisy_0001.exr", "light offset of (2, 0)", "2 x 2"});
  writeWith(1, {2, 2}, {0, -1});
  expectRefused({"noisy_0001.exr", "lightOffset holds no whole numbers"});
  writeWith(1, {2, 5}, {0, 0});
  expectRefused({"noisy_0001.exr", "2 x 5 pixels", "1 to 3"});
  writeWith(1, {2, 1}, {0, 0});
  expectRefused({"noisy_0001.exr", "lightGroup", "noisy_0000.exr"});
}

// Frames 4 and 5 keep the light of different pixels; what they keep is what the files hold.
TEST_F(SequenceTest, KeepsTheShareOfTheLightThatIsAskedFor) {
  files.write(4, 5);
  SequenceOptions options;
  const Sequence whole = open(options);
  options.keptLight = {.columns = 2, .rows = 2};
  const Sequence sequence = open(options);
  EXPECT_EQ(sequence.denoiserLayout().conventions.light, options.keptLight);
  for (const std::size_t index : {0U, 1U}) {
    const Frame frame = sequence.read(index);
    const Frame all = whole.read(index);
    EXPECT_EQ(frame.light, options.keptLight);
    EXPECT_EQ(frame.lightOffset, lightOffsetOfFrame(options.keptLight, 4U + static_cast<std::uint32_t>(index)));
    for (int y = 0; y < all.indirect.height(); ++y) {
      for (int x = 0; x < all.indirect.width(); ++x) {
        const bool kept = x % 2 == frame.lightOffset.x && y % 2 == frame.lightOffset.y;
        for (int c = 0; c < 3; ++c) EXPECT_EQ(frame.indirect.at(x, y, c), kept ? all.indirect.at(x, y, c) : 0.0F);
      }
    }
  }
  EXPECT_EQ(sequence.read(1).previousLightOffset, sequence.read(0).lightOffset);
  EXPECT_NE(sequence.read(1).previousLightOffset, sequence.read(1).lightOffset);

  // Direct light is taken whole, unless it is denoised, too.
  options.light.direct = true;
  const Image direct = open(options).read(0).direct;
  options.keepSomeDirect = true;
  const Frame frame = open(options).read(0);
  EXPECT_GT(std::ranges::max(direct.values()), 0.0F);
  for (int y = 0; y < direct.height(); ++y) {
    for (int x = 0; x < direct.width(); ++x) {
      const bool kept = x % 2 == frame.lightOffset.x && y % 2 == frame.lightOffset.y;
      for (int c = 0; c < 3; ++c) EXPECT_EQ(frame.direct.at(x, y, c), kept ? direct.at(x, y, c) : 0.0F);
      for (int c = 0; c < 3 && y > 0; ++c) EXPECT_GT(direct.at(x, y, c), 0.0F);
    }
  }
}

TEST_F(SequenceTest, KeepsAShareOfFullLightOnly) {
  Frame frame = test::projectFrame(0, 6, 4);
  frame.light = {.columns = 2, .rows = 1};
  writeFrame(directory.path(), frame);
  SequenceOptions options;
  options.keptLight = {.columns = 2, .rows = 2};
  expectRefused({"noisy_0000.exr", "sparse light already", "--light-rate"}, options);
}

TEST_F(SequenceTest, TheChangeOfDepthMayHaveAnotherSource) {
  using enum InputConventions::MotionDepth;
  writeFrame(directory.path(), test::projectFrame(7, 6, 4));
  EXPECT_EQ(open().denoiserLayout().conventions.motionDepth, Given);
  SequenceOptions options;
  options.motionDepth = Found;
  EXPECT_EQ(open(options).denoiserLayout().conventions.motionDepth, Found);
  EXPECT_EQ(open(options).layout().layout, &projectLayout()) << "the files are what they are";
}

TEST_F(SequenceTest, MotionOfTwoChannelsCannotGiveTheChangeOfDepth) {
  using enum InputConventions::MotionDepth;
  files.write(3, 5);
  EXPECT_EQ(open().denoiserLayout().conventions.motionDepth, StaticScene);
  SequenceOptions options;
  options.motionDepth = Found;
  EXPECT_EQ(open(options).denoiserLayout().conventions.motionDepth, Found);
  options.motionDepth = Given;
  expectRefused({"noisy_0003.exr", "no third component"}, options);
}

TEST_F(SequenceTest, ReferencesMayHavePixelsThatAreNanInAllChannels) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  writeFrame(directory.path(), test::projectFrame(7, 6, 4));
  Reference reference{.indirect = Image(6, 4, 3)};
  for (float& value : reference.indirect.pixel(5)) value = kNone;
  writeReference(directory.path(), 7, reference);
  EXPECT_TRUE(std::isnan(open().read(0).reference->indirect.pixel(5)[1]));

  reference.indirect.pixel(9)[1] = kNone;
  writeReference(directory.path(), 7, reference);
  fg::test::expectError<InputError>([&] { static_cast<void>(open().read(0)); }, {"Indirect.G has 1 value(s)"});
}

TEST_F(SequenceTest, ObjectNumbersMustBeInAllFramesOrInNone) {
  const auto numbered = [](Channels& channels) { channels["IndexOB.X"] = Image(6, 4, 1); };
  files.write(0, 1);
  EXPECT_FALSE(open().layout().objectIds);
  EXPECT_TRUE(open().read(0).objectId.empty());
  files.writeFrame(0, numbered);
  expectRefused({"noisy_0001.exr", "IndexOB.X"});
  files.writeFrame(1, numbered);
  EXPECT_TRUE(open().layout().objectIds);
  EXPECT_EQ(open().read(1).objectId.pixelCount(), 24U);
}

TEST_F(SequenceTest, EveryMissingChannelIsNamedWithItsFile) {
  files.write(0, 1);
  for (const char* channel : {"DiffInd.G", "DiffCol.B", "Normal.X", "Depth.Z", "Vector.Y"}) {
    files.writeFrame(1, [&](Channels& channels) { channels.erase(channel); });
    expectRefused({"noisy_0001.exr", channel});
  }
}

// Blender 5 gave passes the names that its windows show (DNA_layer_types.h, RE_PASSNAME_...).
TEST_F(SequenceTest, ReadsTheNamesOfBlender5) {
  files.write(0, 0);
  const auto rename = [](Channels& channels) {
    const std::map<std::string, std::string> names{{"DiffInd", "Diffuse Indirect"}, {"DiffDir", "Diffuse Direct"},
                                                   {"DiffCol", "Diffuse Color"},    {"Emit", "Emission"},
                                                   {"GlossInd", "Glossy Indirect"}, {"GlossCol", "Glossy Color"},
                                                   {"GlossDir", "Glossy Direct"},   {"Env", "Environment"},
                                                   {"IndexOB", "Object Index"}};
    Channels renamed;
    for (auto& [channel, image] : channels) {
      const std::size_t dot = channel.find('.');
      const auto name = names.find(channel.substr(0, dot));
      renamed["ViewLayer." + (name == names.end() ? channel : name->second + channel.substr(dot))] = image;
    }
    channels = std::move(renamed);
  };
  files.writeFrame(0, [&](Channels& channels) {
    addColours(channels, "GlossDir", {0.0F, 0.5F, 0.0F});
    addColours(channels, "GlossInd", {1.0F, 2.0F, 3.0F});
    addColours(channels, "GlossCol", {2.0F, 2.0F, 2.0F});
    addColours(channels, "Env", {0.5F, 0.5F, 0.5F});
    channels["IndexOB.X"] = Image(6, 4, 1);
    rename(channels);
  });
  files.writeReference(0, rename);
  SequenceOptions options;
  options.light = kWholePicture;
  options.light.specular = SpecularWish::IfHeld;
  const Sequence sequence = open(options);
  EXPECT_EQ(sequence.layout().layout, &cyclesLayout5());
  EXPECT_EQ(sequence.layout().plane(Light::Direct), "ViewLayer.Diffuse Direct");
  const Frame frame = sequence.read(0);
  EXPECT_EQ(frame.albedo.at(2, 2, 1), 0.8F);
  EXPECT_EQ(frame.direct.at(2, 2, 1), 0.25F);
  EXPECT_EQ(frame.emission.at(2, 2, 1), 0.5F);
  EXPECT_EQ(frame.nonDiffuse.at(2, 2, 1), 5.0F);
  ASSERT_FALSE(frame.specular.empty());
  EXPECT_EQ(frame.specular.at(2, 2, 1), 2.5F);
  EXPECT_EQ(frame.specularAlbedo.at(2, 2, 1), 2.0F);
  EXPECT_FALSE(frame.objectId.empty());
  EXPECT_EQ(frame.reference->direct.at(2, 2, 0), 0.25F);
}

TEST_F(SequenceTest, DirectLightAloneNeedsNoIndirectLight) {
  files.write(0, 0);
  const auto withoutIndirect = [](Channels& channels) {
    for (const char* const channel : {"DiffInd.R", "DiffInd.G", "DiffInd.B"}) channels.erase(channel);
  };
  files.writeFrame(0, withoutIndirect);
  files.writeReference(0, withoutIndirect);
  expectRefused({"noisy_0000.exr", "DiffInd.R"});
  SequenceOptions options;
  options.light = {.indirect = false, .direct = true};
  const Frame frame = open(options).read(0);
  EXPECT_TRUE(frame.indirect.empty());
  EXPECT_EQ(frame.direct.at(2, 2, 0), 0.25F);
  EXPECT_TRUE(frame.reference->indirect.empty());
  EXPECT_EQ(frame.reference->direct.at(2, 2, 0), 0.25F);
  // A reference without direct light is no error, but one without any light is.
  files.writeReference(0, [](Channels& channels) { channels.erase("DiffDir.R"); });
  expectRefused({"ref_0000.exr", "DiffDir.R"}, options);
  files.writeReference(0, [](Channels& channels) {
    for (const char* const channel : {"DiffDir.R", "DiffDir.G", "DiffDir.B"}) channels.erase(channel);
  });
  EXPECT_TRUE(open(options).read(0).reference->direct.empty());
}

TEST_F(SequenceTest, AReferenceWithoutLightIsNamed) {
  files.write(0, 0);
  files.writeReference(0, [](Channels& channels) { channels.erase("DiffInd.R"); });
  expectRefused({"ref_0000.exr", "DiffInd.R"});
}

TEST_F(SequenceTest, UnknownChannelsAreListed) {
  files.writeCameras(0, 0);
  test::writeChannels(files.frameFile(0), {{"Combined.R", Image(2, 2, 1)}});
  expectRefused({"noisy_0000.exr", "Combined.R", "DiffInd.R", "Indirect.R"});
}

TEST_F(SequenceTest, SizesMustAgree) {
  files.write(0, 2);
  SyntheticSequence(directory.path(), 5, 4).writeFrame(2);
  expectRefused({"noisy_0002.exr", "5 x 4", "6 x 4"});
  files.writeFrame(2);
  SyntheticSequence(directory.path(), 6, 3).writeReference(1);
  expectRefused({"ref_0001.exr", "6 x 3", "6 x 4"});
}

TEST_F(SequenceTest, AGapIsNamedAndARangeAvoidsIt) {
  files.write(0, 4);
  std::filesystem::remove(files.frameFile(2));
  expectRefused({"frame 2 is missing", "--frames"});
  SequenceOptions options;
  options.frames = FrameRange{3, 4};
  EXPECT_EQ(open(options).entries().size(), 2U);
  options.frames = FrameRange{3, 9};
  expectRefused({"frame 5 is missing", "0 to 4"}, options);
}

TEST_F(SequenceTest, TwoFilesOfOneFrameAreRefused) {
  files.write(0, 0);
  std::filesystem::copy(files.frameFile(0), directory.path() / "other_00.exr");
  expectRefused({"frame 0 exists twice", "noisy_0000.exr", "other_00.exr"});
}

TEST_F(SequenceTest, AnEmptyOrMissingFolderIsRefused) {
  expectRefused({directory.path().c_str(), "no frames"});
  fg::test::expectError<InputError>([&] { Sequence(directory.path() / "nowhere", {}); }, {"nowhere", "not a folder"});
}

TEST_F(SequenceTest, MissingCamerasAreNamed) {
  files.write(0, 2);
  files.writeCameras(0, 1);
  expectRefused({"cameras.json", "frame 2", "noisy_0002.exr"});
  std::filesystem::remove(directory.path() / "cameras.json");
  expectRefused({"cameras.json", "prev_view"});
}

TEST_F(SequenceTest, BadCameraFilesAreNamed) {
  files.write(0, 1);
  const auto expectBad = [&](const std::function<void(nlohmann::json&)>& edit,
                             std::initializer_list<std::string_view> parts) {
    files.writeCameras(0, 1);
    editCameras(edit);
    expectRefused(parts);
  };
  expectBad([](auto& frames) { frames[1].erase("prev_view"); }, {"cameras.json", "frame 1", "prev_view"});
  expectBad([](auto& frames) { frames[1]["view"].erase(3); }, {"frame 1", "view", "16"});
  expectBad([](auto& frames) { frames[1]["view"][3] = "x"; }, {"frame 1", "view", "16"});
  const nlohmann::json row = {1.0, 0.0, 0.0, 0.0};
  expectBad(
      [&](auto& frames) {
        frames[1]["view"] = {row, row, row, row};
      },
      {"frame 1", "view", "16 numbers", "column after column"});
  expectBad([](auto& frames) { frames[1]["projection"][3] = 1e300; }, {"frame 1", "projection", "not finite"});
  expectBad([](auto& frames) { frames[1]["jitter"] = {0.0, 1e39}; }, {"frame 1", "jitter", "not finite"});
  expectBad([](auto& frames) { frames[1]["frame"] = 4294967296; }, {"frame 4294967296", "out of range"});
  expectBad([](auto& frames) { frames[1]["frame"] = 18446744073709551615U; }, {"frame 18446744073709551615", "range"});
  expectBad([](auto& frames) { frames[1]["frame"] = -1; }, {"frame -1", "out of range"});
  expectBad([](auto& frames) { frames[1]["frame"] = 0; }, {"frame 0", "twice"});
  expectBad([](auto& frames) { frames[1].erase("frame"); }, {"frame"});
  expectBad([](auto& frames) { frames = 3; }, {"frames"});
  test::writeText(directory.path() / "cameras.json", "{\"frames\": [");
  expectRefused({"cameras.json", "JSON"});
  test::writeText(directory.path() / "cameras.json", R"({"frames": [{"frame": 0, "view": [1e999]}]})");
  expectRefused({"cameras.json", "JSON", "1e999"});
  std::filesystem::remove(directory.path() / "cameras.json");
  ASSERT_EQ(mkfifo((directory.path() / "cameras.json").c_str(), 0600), 0);
  expectRefused({"cameras.json", "not a regular file"});
}

/// All channels of the project's own layout, each with the same values.
Channels projectChannels() {
  const Frame frame = test::projectFrame(0, 6, 4);
  Channels channels;
  for (const char* name : {"Indirect.R", "Indirect.G", "Indirect.B", "Albedo.R", "Albedo.G", "Albedo.B", "Normal.X",
                           "Normal.Y", "Normal.Z", "Depth.Z", "Motion.X", "Motion.Y", "Motion.Z"}) {
    channels[name] = frame.depth;
  }
  return channels;
}

TEST_F(SequenceTest, AJitterThatIsNotFiniteIsNamed) {
  const Channels channels = projectChannels();
  std::vector<ExrChannel> stored;
  for (const auto& [name, image] : channels) stored.push_back({name, &image, 0, ExrType::Float});
  const glm::mat4 matrix(1.0F);
  const std::vector<ExrAttribute> attributes{{kViewAttribute, matrix},
                                             {kPreviousViewAttribute, matrix},
                                             {kProjectionAttribute, matrix},
                                             {kJitterAttribute, glm::vec2(0.0F, std::nanf(""))}};
  writeExr(files.frameFile(0), stored, attributes);
  expectRefused({"noisy_0000.exr", "jitter", "not finite"});
}

TEST_F(SequenceTest, AMissingCameraAttributeIsNamed) {
  test::writeChannels(files.frameFile(0), projectChannels());
  expectRefused({"noisy_0000.exr", "worldToCamera"});
}

TEST_F(SequenceTest, CutsComeFromCamerasTheirFlagOrTheCaller) {
  files.write(0, 4);
  editCameras([](nlohmann::json& frames) {
    frames[1]["prev_view"][12] = 1e-7;  // A rounding error: no cut.
    frames[2]["prev_view"][12] = 0.01;  // Differs from the view of frame 1: a cut.
    frames[3]["cut"] = true;
  });
  SequenceOptions options;
  options.cuts = {4};
  const Sequence sequence = open(options);
  std::vector<bool> cuts;
  for (const Sequence::Entry& entry : sequence.entries()) {
    cuts.push_back(entry.camera.cut);
  }
  EXPECT_EQ(cuts, (std::vector<bool>{false, false, true, true, true}));
  options.cuts = {9};
  expectRefused({"--cut 9", "0 to 4"}, options);
}

TEST_F(SequenceTest, JitterAndProjectionOfTheFrameBeforeAreKept) {
  files.write(0, 1);
  editCameras([](nlohmann::json& frames) {
    frames[0]["jitter"] = {0.25, -0.5};
    frames[0]["projection"][0] = 2.0;
  });
  const Frame frame = open().read(1);
  EXPECT_EQ(frame.previousJitter, glm::vec2(0.25F, -0.5F));
  EXPECT_EQ(frame.camera.jitter, glm::vec2(0.0F));
  EXPECT_EQ(frame.previousProjection[0][0], 2.0F);
}

class NonFiniteTest : public SequenceTest, public testing::WithParamInterface<const char*> {};

TEST_P(NonFiniteTest, IsRefusedWithPositionAndCountOrAcceptedOnRequest) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) {
    channels.at(GetParam()).at(4, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    channels.at(GetParam()).at(2, 3, 0) = -std::numeric_limits<float>::infinity();
  });
  SequenceOptions options;
  options.light = kWholePicture;
  fg::test::expectError<InputError>([&] { static_cast<void>(open(options).read(0)); },
                                    {"noisy_0000.exr", GetParam(), "2 value(s)", "(4, 1)", "--non-finite replace"});
  options.nonFinite = NonFinitePolicy::Replace;
  const Frame frame = open(options).read(0);
  ASSERT_EQ(frame.nonFinite.size(), 1U);
  EXPECT_EQ(frame.nonFinite[0].channel, GetParam());
}

INSTANTIATE_TEST_SUITE_P(EveryChannel, NonFiniteTest,
                         testing::Values("DiffInd.R", "DiffInd.G", "DiffInd.B", "DiffDir.R", "DiffDir.G", "DiffDir.B",
                                         "DiffCol.R", "DiffCol.G", "DiffCol.B", "Normal.X", "Normal.Y", "Normal.Z",
                                         "Depth.Z", "Vector.X", "Vector.Y", "Emit.R", "Emit.G", "Emit.B"));

TEST(SharedDataSequences, AreRecognisedAndRead) {
  const test::SharedData root("sequences");
  if (!root) GTEST_SKIP() << root.whyNot();
  for (const char* name : {"sponza", "cornell_fence"}) {
    const Sequence sequence(root.path() / name, {});
    EXPECT_EQ(sequence.layout().layout, &cyclesLayout());
    EXPECT_EQ(sequence.extent(), (fg::Extent{384, 216}));
    EXPECT_TRUE(sequence.hasReferences());
    for (const Sequence::Entry& entry : sequence.entries()) {
      EXPECT_FALSE(entry.camera.cut) << entry.number;
    }
    EXPECT_TRUE(sequence.read(sequence.entries().size() - 1).nonFinite.empty());
  }
}

}  // namespace
}  // namespace walr
