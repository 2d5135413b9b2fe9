// Light of a frame beside what is denoised: that of whole pictures.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "samples/sequence/sequence.h"
#include "samples/sequence/writer.h"
#include "tests/error_text.h"
#include "tests/samples/sequence_fixture.h"

namespace walr {
namespace {

using test::addColours;
using test::Channels;

class CompositeSequence : public test::SequenceFixture {};

TEST_F(CompositeSequence, CompositeChannelsAreNeededForACompositeOnly) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) {
    channels.erase("DiffDir.R");
    channels.erase("Emit.B");
  });
  EXPECT_NO_THROW((void)open());
  SequenceOptions options;
  options.light = kWholePicture;
  expectRefused({"DiffDir.R, Emit.B", "--composite"}, options);
}

TEST_F(CompositeSequence, AddsTheSkyOfBlenderToItsEmission) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) {
    for (const char* const component : {"R", "G", "B"}) {
      Image sky(channels.at("Emit.R").width(), channels.at("Emit.R").height(), 1);
      sky.at(1, 0, 0) = 3.0F;
      channels.emplace(std::string("Env.") + component, sky);
    }
  });
  SequenceOptions options;
  options.light = kWholePicture;
  const Frame frame = open(options).read(0);
  EXPECT_TRUE(open().read(0).emission.empty());
  EXPECT_EQ(frame.emission.at(1, 0, 2), frame.emission.at(0, 0, 2) + 3.0F);
}

TEST_F(CompositeSequence, AddsEveryLightThatIsNotDiffuse) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) {
    addColours(channels, "GlossDir", {1.0F, 2.0F, 3.0F});
    addColours(channels, "GlossInd", {0.5F, 0.0F, 1.0F});
    addColours(channels, "GlossCol", {0.5F, 0.25F, 0.0F});
    addColours(channels, "TransInd", {8.0F, 8.0F, 8.0F});
    addColours(channels, "TransCol", {0.125F, 0.25F, 0.5F});
    addColours(channels, "VolumeDir", {0.0F, 16.0F, 0.0F});
    addColours(channels, "VolumeInd", {32.0F, 0.0F, 0.0F});
  });
  SequenceOptions options;
  options.light = kWholePicture;
  const Sequence sequence = open(options);
  EXPECT_EQ(describeUndenoised(sequence.layout(), std::array{Light::Indirect}),
            "DiffDir x DiffCol, Emit, GlossDir x GlossCol, GlossInd x GlossCol, TransInd x TransCol, VolumeDir, "
            "VolumeInd");
  EXPECT_EQ(describeMissing(sequence.layout()), "Env, TransDir");
  const Frame frame = sequence.read(0);
  EXPECT_EQ(frame.nonDiffuse.at(2, 2, 0), 1.5F * 0.5F + 8.0F * 0.125F + 32.0F);
  EXPECT_EQ(frame.nonDiffuse.at(2, 2, 1), 2.0F * 0.25F + 8.0F * 0.25F + 16.0F);
  EXPECT_EQ(frame.nonDiffuse.at(2, 2, 2), 8.0F * 0.5F);
  EXPECT_TRUE(open().read(0).nonDiffuse.empty());
}

TEST_F(CompositeSequence, LightThatIsNotFiniteHidesNoOther) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) {
    addColours(channels, "VolumeDir", {1.0F, 1.0F, 1.0F});
    addColours(channels, "VolumeInd", {std::numeric_limits<float>::infinity(), 2.0F, 2.0F});
  });
  SequenceOptions options;
  options.light = kWholePicture;
  fg::test::expectError<InputError>([&] { static_cast<void>(open(options).read(0)); }, {"VolumeInd.R", "24 value(s)"});
  options.nonFinite = NonFinitePolicy::Replace;
  const Frame frame = open(options).read(0);
  EXPECT_EQ(frame.nonDiffuse.at(2, 2, 0), 1.0F);
  EXPECT_EQ(frame.nonDiffuse.at(2, 2, 1), 3.0F);
}

TEST_F(CompositeSequence, AddedLightsMustBeWholeAndInAllFrames) {
  files.write(0, 1);
  const auto glossy = [](Channels& channels) {
    addColours(channels, "GlossDir", {1.0F, 1.0F, 1.0F});
    addColours(channels, "GlossCol", {1.0F, 1.0F, 1.0F});
  };
  files.writeFrame(0, glossy);
  SequenceOptions options;
  options.light = kWholePicture;
  expectRefused({"noisy_0001.exr", "GlossDir.R, GlossDir.G, GlossDir.B, GlossCol.R", "--composite"}, options);
  EXPECT_NO_THROW((void)open());
  files.writeFrame(1, glossy);
  EXPECT_NO_THROW((void)open(options));
  files.writeFrame(0, [&](Channels& channels) {
    glossy(channels);
    channels.erase("GlossCol.G");
  });
  expectRefused({"noisy_0000.exr", "missing channel GlossCol.G"}, options);
}

TEST_F(CompositeSequence, SpecularLightMustBeInAllFramesOrInNone) {
  Frame frame = test::projectFrame(0, 6, 4);
  frame.specular = frame.specularAlbedo = Image(6, 4, 3);
  frame.specularDistance = frame.roughness = Image(6, 4, 1);
  writeFrame(directory.path(), frame);
  writeFrame(directory.path(), test::projectFrame(1, 6, 4));
  SequenceOptions options;
  options.light.specular = SpecularWish::IfHeld;
  expectRefused({"noisy_0001.exr", "Specular.R", "SpecularDistance.Z", "Roughness.Y", "SpecularAlbedo.B"}, options);
}

TEST_F(CompositeSequence, SparseSpecularLightHasNoComposite) {
  Frame frame = test::projectFrame(0, 6, 4);
  frame.specular = frame.specularAlbedo = Image(6, 4, 3);
  frame.specularDistance = frame.roughness = Image(6, 4, 1);
  frame.light = {.columns = 2};
  writeFrame(directory.path(), frame);
  SequenceOptions options;
  options.light.specular = SpecularWish::IfHeld;
  EXPECT_FALSE(open(options).read(0).specular.empty());
  options.light.rest = true;
  expectRefused({"noisy_0000.exr", "specular light", "--composite"}, options);
}

// Each light of a reference, and each half of its samples, is left out or wrong by itself.
TEST_F(CompositeSequence, EveryLightOfAReferenceIsChecked) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  writeFrame(directory.path(), test::projectFrame(7, 6, 4));
  const Image light(6, 4, 3);
  Reference reference{.indirect = light, .direct = light, .indirectHalf = light, .specular = light};
  for (float& value : reference.direct.pixel(5)) value = kNone;
  writeReference(directory.path(), 7, reference);
  SequenceOptions options;
  options.light = {.direct = true, .specular = SpecularWish::IfHeld};
  EXPECT_TRUE(std::isnan(open(options).read(0).reference->direct.pixel(5)[1]));

  const auto expectNamed = [&](Image& image, std::string_view channel) {
    image.pixel(9)[1] = kNone;
    writeReference(directory.path(), 7, reference);
    fg::test::expectError<InputError>([&] { static_cast<void>(open(options).read(0)); }, {channel, "has 1 value(s)"});
    image.pixel(9)[1] = 0.0F;
  };
  expectNamed(reference.direct, "Direct.G");
  expectNamed(reference.indirectHalf, "IndirectA.G");
}

}  // namespace
}  // namespace walr
