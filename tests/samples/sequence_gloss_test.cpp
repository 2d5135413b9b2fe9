// Glossy light of Cycles as specular light: with roughness if the files hold it, and with distances if there are files
// of them.
#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/sequence/sequence.h"
#include "tests/error_text.h"
#include "tests/samples/sequence_fixture.h"

namespace walr {
namespace {

using test::addColours;
using test::Channels;

void addGloss(Channels& channels) {
  addColours(channels, "GlossDir", {1.0F, 2.0F, 3.0F});
  addColours(channels, "GlossInd", {0.5F, 0.0F, 1.0F});
  addColours(channels, "GlossCol", {0.5F, 0.25F, 0.0F});
}

class GlossSequence : public test::SequenceFixture {
 protected:
  GlossSequence() {
    files.write(0, 0);
    options.light.specular = SpecularWish::IfHeld;
  }

  SequenceOptions options;
};

// Cycles has divided both lights by the colour already: its manual says that passes of light leave it out.
TEST_F(GlossSequence, IsTheSumOfBothLightsWithTheirColourAsAlbedo) {
  files.writeFrame(0, addGloss);
  files.writeReference(0, [](Channels& channels) {
    addColours(channels, "GlossDir", {8.0F, 0.0F, 0.0F});
    addColours(channels, "GlossInd", {16.0F, 0.0F, 0.0F});
    addColours(channels, "GlossDirA", {4.0F, 0.0F, 0.0F});
  });
  for (const bool rest : {false, true}) {
    options.light.rest = options.light.direct = rest;
    const Frame frame = open(options).read(0);
    ASSERT_FALSE(frame.specular.empty() || frame.reference->specular.empty());
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(frame.specular.at(2, 2, c), (std::vector{1.5F, 2.0F, 4.0F}[static_cast<std::size_t>(c)]));
      EXPECT_EQ(frame.specularAlbedo.at(2, 2, c), (std::vector{0.5F, 0.25F, 0.0F}[static_cast<std::size_t>(c)]));
    }
    EXPECT_TRUE(frame.specularDistance.empty());
    EXPECT_TRUE(frame.roughness.empty());
    EXPECT_EQ(frame.reference->specular.at(2, 2, 0), 24.0F);
    EXPECT_TRUE(frame.reference->specularHalf.empty());  // One of its two planes is missing.
    EXPECT_EQ(frame.nonDiffuse.empty(), !rest);
    if (rest) {
      EXPECT_EQ(frame.nonDiffuse.at(2, 2, 0), 1.5F * 0.5F);
    }
  }
  EXPECT_TRUE(open().read(0).specular.empty());
}

TEST_F(GlossSequence, HasTheRoughnessThatMaterialsWrite) {
  files.write(0, 1);
  const auto withRoughness = [](Channels& channels) {
    addGloss(channels);
    channels["Roughness.X"] = Image(6, 4, 1);
    channels["Roughness.X"].at(2, 2, 0) = 0.25F;
  };
  files.writeFrame(0, withRoughness);
  files.writeFrame(1, addGloss);
  expectRefused({"noisy_0001.exr", "missing channel Roughness.X"}, options);
  files.writeFrame(1, withRoughness);
  EXPECT_EQ(open(options).read(1).roughness.at(2, 2, 0), 0.25F);
}

TEST_F(GlossSequence, IsReadOnlyIfBothLightsAreThere) {
  files.writeFrame(0, [](Channels& channels) {
    addGloss(channels);
    channels.erase("GlossCol.G");
  });
  expectRefused({"noisy_0000.exr", "missing channel GlossCol.G"}, options);
  files.writeFrame(0, [](Channels& channels) { addColours(channels, "GlossDir", {1.0F, 1.0F, 1.0F}); });
  const Frame frame = open(options).read(0);
  EXPECT_TRUE(frame.specular.empty());
  EXPECT_TRUE(frame.specularAlbedo.empty());
}

/// Files of distances and roughness, as `blender/export_frames.py` writes them.
class GlossFiles : public GlossSequence {
 protected:
  GlossFiles() {
    files.writeCameras(0, 1);
    files.writeReference(0, addGloss);
    for (const int number : {0, 1}) {
      files.writeFrame(number, addGloss);
      write(number);
    }
    options.light = {.indirect = false, .specular = SpecularWish::Denoised};
  }

  [[nodiscard]] std::filesystem::path file(int number) const {
    return files.folder() / ("specular_000" + std::to_string(number) + ".exr");
  }

  // One of two samples met something at 4 units in the pixel (2, 2), half of which is a lobe of roughness .25; in (3,
  // 2) both left the scene; in (4, 2) none left the surface.
  void write(int number, const test::Edit& edit = {}) const {
    Channels channels;
    for (const char* const plane : {"GlossDir", "Emit"}) addColours(channels, plane, {0.0F, 0.0F, 0.0F});
    channels["GlossDir.R"].at(2, 2, 0) = 0.125F;
    channels["GlossDir.G"].at(2, 2, 0) = 0.5F;
    channels["GlossDir.G"].at(3, 2, 0) = 1.0F;
    channels["Emit.R"].at(2, 2, 0) = 0.125F;
    channels["Emit.G"].at(2, 2, 0) = 0.5F;
    if (edit) edit(channels);
    test::writeChannels(file(number), channels);
  }
};

TEST_F(GlossFiles, AreReadWithTheLight) {
  // Where materials write roughness, too, the file knows better: such a pass adds up what lies behind a hole.
  for (const bool pass : {false, true}) {
    if (pass) {
      for (const int number : {0, 1}) {
        files.writeFrame(number, [](Channels& channels) {
          addGloss(channels);
          channels["Roughness.X"] = Image(6, 4, 1);
        });
      }
    }
    const Sequence sequence = open(options);
    for (const Role role : {Role::SpecularDistance, Role::Roughness}) EXPECT_TRUE(sequence.layout().hasSpecular(role));
    const Frame frame = sequence.read(1);
    EXPECT_EQ(frame.specularDistance.at(2, 2, 0), 4.0F);
    EXPECT_EQ(frame.specularDistance.at(3, 2, 0), kBackgroundDepth);
    EXPECT_EQ(frame.specularDistance.at(4, 2, 0), kBackgroundDepth);
    EXPECT_EQ(frame.roughness.at(2, 2, 0), 0.25F);
    EXPECT_EQ(frame.roughness.at(3, 2, 0), 1.0F);
    EXPECT_EQ(sequence.assumption(), "");
    EXPECT_TRUE(open().read(1).specularDistance.empty());
  }
}

TEST_F(GlossFiles, AreThereForAllFramesOrForNone) {
  std::filesystem::remove(file(1));
  expectRefused({"specular_0000.exr", "frame 1", "Export the missing frames"}, options);
  std::filesystem::remove(file(0));
  write(1);
  expectRefused({"specular_0001.exr", "frame 0"}, options);
  std::filesystem::remove(file(1));
  expectRefused({"noisy_0000.exr", "roughness", "export_frames.py"}, options);
  for (const int number : {0, 1}) {
    files.writeFrame(number, [](Channels& channels) {
      addGloss(channels);
      channels["Roughness.X"] = Image(6, 4, 1);
    });
  }
  EXPECT_FALSE(open(options).layout().hasSpecular(Role::SpecularDistance));
  EXPECT_EQ(open(options).read(0).specularDistance.at(2, 2, 0), kBackgroundDepth);
  EXPECT_NE(open(options).assumption().find("taken to be far away"), std::string::npos);
  options.light.specular = SpecularWish::IfHeld;
  EXPECT_EQ(open(options).assumption(), "");
  EXPECT_TRUE(open(options).read(0).specularDistance.empty());
}

TEST_F(GlossFiles, AreNoFrames) {
  for (const int number : {0, 1}) std::filesystem::remove(files.frameFile(number));
  expectRefused({"holds no frames", "specular_0000.exr", "'specular'"}, options);
}

TEST_F(GlossFiles, MustFitTheFrames) {
  write(1, [](Channels& channels) { channels.erase("Emit.G"); });
  expectRefused({"specular_0001.exr", "missing channel Emit.G", "'specular'"}, options);
  write(1, [](Channels& channels) {
    for (auto& [name, image] : channels) image = Image(5, 4, 1);
  });
  expectRefused({"specular_0001.exr", "5 x 4"}, options);
  write(1, [](Channels& channels) { channels["GlossDir.R"].at(1, 1, 0) = std::numeric_limits<float>::infinity(); });
  fg::test::expectError<InputError>([&] { static_cast<void>(open(options).read(1)); },
                                    {"specular_0001.exr", "GlossDir.R", "(1, 1)"});
}

}  // namespace
}  // namespace walr
