#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/matrix.hpp>

#include "samples/image/exr.h"
#include "samples/sequence/sequence.h"
#include "samples/sequence/writer.h"
#include "tests/samples/exr_files.h"
#include "tests/samples/walr_program.h"

namespace walr {
namespace {

using test::Channels;
using test::expectFailure;
using test::expectSuccess;
using test::kInput;
using test::kUsage;
using test::ProcessResult;

TEST_F(ProgramTest, LintsFrames) {
  files.write(0, 2);
  const ProcessResult good = walr({"lint", input.string(), "--validate"});
  expectSuccess(good);
  EXPECT_NE(good.out.find("3 frames, nothing looks wrong"), std::string::npos) << good.out;
  const auto halve = [](Channels& channels) {
    for (auto& [name, plane] : channels) {
      if (name.find("Normal.") == std::string::npos) continue;
      for (float& value : plane.values()) value *= 0.5F;
    }
  };
  for (int frame = 0; frame <= 2; ++frame) files.writeFrame(frame, halve);
  const ProcessResult spoiled = walr({"lint", input.string(), "--frames", "0-1", "--validate"});
  expectFailure(spoiled, kInput, {"1 thing looks wrong"});
  EXPECT_NE(spoiled.out.find("normal-not-unit: normals are not of length 1 on"), std::string::npos) << spoiled.out;
  EXPECT_NE(spoiled.out.find("Way out: "), std::string::npos) << spoiled.out;
}

// walr denoise refuses them; a depth that is infinite is sky to the linter.
TEST_F(ProgramTest, LintsWhatIsNotFiniteInTheSky) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) { channels.at("Depth.Z").at(2, 0, 0) = HUGE_VALF; });
  const ProcessResult result = walr({"lint", input.string()});
  expectFailure(result, kInput, {"1 thing looks wrong"});
  EXPECT_NE(result.out.find("noisy_0000.exr: channel Depth.Z is NaN or infinite on 1 pixels"), std::string::npos)
      << result.out;
}

// A pixel whose channels are all NaN is left out of the error; one that is infinite is a fault of the render.
TEST_F(ProgramTest, LintsWhatIsNotFiniteInAReference) {
  files.write(0, 0);
  files.writeReference(0, [](Channels& channels) {
    for (auto& [name, plane] : channels) plane.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  });
  expectSuccess(walr({"lint", input.string()}));
  files.writeReference(0, [](Channels& channels) { channels.at("DiffInd.G").at(5, 7, 0) = HUGE_VALF; });
  const ProcessResult result = walr({"lint", input.string()});
  expectFailure(result, kInput, {"1 thing looks wrong"});
  EXPECT_TRUE(result.out.starts_with("reference-not-finite: ")) << result.out;
  EXPECT_NE(result.out.find(
                "ref_0000.exr: channel DiffInd.G is NaN or infinite on 1 pixels of a reference, the first at (5, 7)"),
            std::string::npos)
      << result.out;
}

TEST_F(ProgramTest, LintsDirectLightOnRequest) {
  files.write(0, 0);
  files.writeFrame(0, [](Channels& channels) { channels.at("DiffDir.R").at(5, 7, 0) = HUGE_VALF; });
  expectSuccess(walr({"lint", input.string()}));
  const ProcessResult result = walr({"lint", input.string(), "--light", "direct"});
  expectFailure(result, kInput, {"1 thing looks wrong"});
  EXPECT_TRUE(result.out.starts_with("lighting-not-finite: ")) << result.out;
}

TEST_F(ProgramTest, LintsWhatItRendered) {
  const std::string scene = std::string(WALR_SCENES) + "/box.gltf";
  expectSuccess(walr({"render", scene, "--output", input.string(), "--frames", "0-3", "--size", "96x54",
                      "--reference-spp", "0", "--jitter"}));
  const ProcessResult result = walr({"lint", input.string(), "--validate"});
  expectSuccess(result);
  EXPECT_NE(result.out.find("4 frames, nothing looks wrong"), std::string::npos) << result.out;
}

// Mistakes of frames that other people's renderers wrote.
TEST_F(ProgramTest, LintNamesTheMistakeOfASequence) {
  const std::string scene = std::string(WALR_SCENES) + "/box.gltf";
  expectSuccess(walr({"render", scene, "--output", output.string(), "--frames", "8-11", "--size", "96x54",
                      "--reference-spp", "0", "--jitter"}));
  const Sequence right(output, {});
  struct Mistake {
    const char* finding;
    std::function<void(Frame&)> make;
  };
  const std::vector<Mistake> mistakes{
      {"camera-still", [](Frame& frame) { frame.camera.previousView = frame.camera.view; }},
      {"cut-every-frame", [](Frame& frame) { frame.camera.cut = true; }},
      {"view-inverted",
       [](Frame& frame) {
         frame.camera.view = glm::inverse(frame.camera.view);
         frame.camera.previousView = glm::inverse(frame.camera.previousView);
       }},
      {"jitter-missing", [](Frame& frame) { frame.camera.jitter = {}; }},
      {"lighting-half-empty",
       [](Frame& frame) {
         for (int y = 0; y < frame.indirect.height(); ++y) {
           for (int x = (y + frame.number) % 2; x < frame.indirect.width(); x += 2) {
             for (int c = 0; c < 3; ++c) frame.indirect.at(x, y, c) = 0.0F;
           }
         }
       }},
      {"lighting-zero", [](Frame& frame) { std::ranges::fill(frame.indirect.values(), 0.0F); }},
      {"projection", [](Frame& frame) { frame.camera.projection[0][0] = frame.camera.projection[1][1]; }},
      {"frames-repeated",
       [&](Frame& frame) {
         const int number = std::exchange(frame, right.read(1)).number;
         frame.number = number;
       }},
      {"depth-unit",
       [](Frame& frame) {
         for (float& depth : frame.depth.values()) depth = depth < kSkyDepth ? 100.0F * depth : depth;
       }},
  };
  for (const Mistake& mistake : mistakes) {
    for (std::size_t i = 0; i < right.entries().size(); ++i) {
      Frame frame = right.read(i);
      mistake.make(frame);
      writeFrame(input, frame);
    }
    const ProcessResult result = walr({"lint", input.string()});
    expectFailure(result, kInput, {"1 thing looks wrong"});
    EXPECT_TRUE(result.out.starts_with(std::string(mistake.finding) + ": ")) << mistake.finding << "\n" << result.out;
  }
}

// DWA and B44 make dark values negative, which no renderer and no filter did.
TEST_F(ProgramTest, LintsNegativeLightOfLossyFilesAsThat) {
  files.writeCameras(0, 0);
  for (const auto& [compression, cause] : {std::pair{Imf::B44_COMPRESSION, "lossy compression"},
                                           std::pair{Imf::ZIP_COMPRESSION, "reconstruction filter"}}) {
    writeCycles(input / "f0.exr", {.channels = {}, .compression = compression, .factor = -1.0F}, {{0, 0}, {5, 3}});
    const ProcessResult result = walr({"lint", input.string()});
    const std::size_t found = result.out.find("lighting-negative");
    ASSERT_NE(found, std::string::npos) << result.out;
    EXPECT_NE(result.out.find(cause, found), std::string::npos) << result.out;
  }
}

TEST_F(ProgramTest, TellsTheLinterAndTheDenoiserThatMotionHasNoDepth) {
  const std::string scene = std::string(WALR_SCENES) + "/box.gltf";
  expectSuccess(walr(
      {"render", scene, "--output", input.string(), "--frames", "8-11", "--size", "96x54", "--reference-spp", "0"}));
  const Sequence sequence(input, {});
  for (std::size_t i = 0; i < sequence.entries().size(); ++i) {
    Frame frame = sequence.read(i);
    for (std::size_t pixel = 0; pixel < frame.motion.pixelCount(); ++pixel) frame.motion.pixel(pixel)[2] = 0.0F;
    writeFrame(input, frame);
  }
  const ProcessResult given = walr({"lint", input.string(), "--motion-depth", "given"});
  expectFailure(given, kInput, {"1 thing looks wrong"});
  EXPECT_NE(given.out.find("motion-z-missing"), std::string::npos) << given.out;
  expectSuccess(walr({"lint", input.string(), "--motion-depth", "found", "--validate"}));
  expectSuccess(denoise({"--motion-depth", "found"}));
  expectFailure(walr({"lint", input.string(), "--motion-depth", "guessed"}), kUsage, {"--motion-depth"});
}

}  // namespace
}  // namespace walr
