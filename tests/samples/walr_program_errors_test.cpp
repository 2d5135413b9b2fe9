// What the program does with input, devices and outputs that it cannot use.
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samples/image/exr.h"
#include "samples/sequence/writer.h"
#include "tests/samples/walr_program.h"

namespace walr {
namespace {

namespace fs = std::filesystem;
using test::Channels;
using test::expectFailure;
using test::expectSuccess;
using test::kDevice;
using test::kInput;
using test::kOutput;
using test::kUsage;
using test::ProcessOptions;
using test::ProcessResult;
using test::SyntheticSequence;

TEST_F(ProgramTest, BadInputIsNamedBeforeAnythingIsWritten) {
  const auto expectBad = [&](std::initializer_list<std::string_view> parts) {
    expectFailure(denoise(), kInput, parts);
    EXPECT_FALSE(fs::exists(output));
  };
  files.write(0, 3);
  files.writeFrame(1, [](Channels& channels) { channels.erase("Normal.Y"); });
  expectBad({"noisy_0001.exr", "Normal.Y"});
  SyntheticSequence(input, 5, 5).writeFrame(1);
  expectBad({"noisy_0001.exr", "5 x 5", "24 x 18"});
  fs::remove(files.frameFile(1));
  expectBad({"frame 1 is missing"});
  files.writeFrame(1);
  files.writeCameras(0, 2);
  expectBad({"cameras.json", "frame 3"});
  fs::remove(input / "cameras.json");
  expectBad({"cameras.json"});
  files.writeCameras(0, 3);
  test::writeText(files.frameFile(2), "not an image");
  expectBad({"noisy_0002.exr"});
}

TEST_F(ProgramTest, ATruncatedFrameLeavesTheFinishedOnesWhole) {
  files.write(0, 3);
  const std::string whole = test::readText(files.frameFile(2));
  test::writeText(files.frameFile(2), whole.substr(0, whole.size() / 2));
  expectFailure(denoise(), kInput, {"noisy_0002.exr", "truncated or damaged"});
  for (const std::string& name : outputFiles()) {
    EXPECT_TRUE(name == "denoised_0000.exr" || name == "denoised_0001.exr") << name;
    expectFinite(readPlane(output / name));
  }
}

TEST_F(ProgramTest, WrongCamerasAreNamed) {
  files.write(0, 0);
  std::string cameras = test::readText(input / "cameras.json");
  auto document = nlohmann::json::parse(cameras);
  document["frames"][0]["view"] = std::vector<double>(16, 0.0);
  document["frames"][0]["prev_view"] = std::vector<double>(16, 0.0);
  test::writeText(input / "cameras.json", document.dump());
  expectFailure(denoise(), kInput, {"camera of frame 0"});
  files.writeCameras(0, 0);
  document = nlohmann::json::parse(test::readText(input / "cameras.json"));
  document["frames"][0]["projection"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -0.1, 0, 0, 0, -1, 1};
  test::writeText(input / "cameras.json", document.dump());
  expectFailure(walr({"lint", input.string()}), kInput,
                {"camera of frame 0", "orthographic", "sequence need a perspective camera"});
}

TEST_F(ProgramTest, NoVulkanDeviceIsSaid) {
  files.write(0, 0);
  const ProcessOptions options{{{"VK_DRIVER_FILES", "/nonexistent"}, {"VK_ICD_FILENAMES", "/nonexistent"}}, {}};
  expectFailure(denoise({}, options), kDevice, {"Vulkan"});
  expectFailure(walr({"denoise", "--list-devices"}, options), kDevice, {"Vulkan"});
}

TEST_F(ProgramTest, ADeviceThatLacksSomethingIsToldWhat) {
  files.write(0, 0);
  // The run ends before the first command buffer, so that there is nothing for the validation layer to check.
  const auto denoiseOnPoorDevice = [&](const char* lacks) {
    return walr({"denoise", input, "--output", output}, {{{"VK_LAYER_PATH", WALR_LACKING_LAYER},
                                                          {"VK_INSTANCE_LAYERS", "VK_LAYER_WALR_lacking"},
                                                          {"WALR_TEST_LACKS", lacks}},
                                                         {}});
  };
  expectSuccess(denoiseOnPoorDevice("nothing"));
  expectFailure(denoiseOnPoorDevice("synchronization2"), kDevice, {"lacks", "synchronization2", "driver"});
  expectFailure(denoiseOnPoorDevice("storage images"), kDevice, {"lacks", "storage image", "format"});
}

TEST_F(ProgramTest, AnUnknownDeviceIsNamed) {
  files.write(0, 0);
  expectFailure(denoise({"--device", "abacus"}), kDevice, {"abacus"});
  expectFailure(denoise({"--device", "99"}), kDevice, {"99"});
}

TEST_F(ProgramTest, ListsDevices) {
  const ProcessResult result = walr({"denoise", "--list-devices"});
  expectSuccess(result);
  EXPECT_EQ(result.out.rfind("0: ", 0), 0U) << result.out;
}

TEST_F(ProgramTest, AnOutputThatCannotBeMadeIsNamed) {
  files.write(0, 0);
  test::writeText(output, "a file");
  expectFailure(denoise(), kOutput, {output.string(), "not a directory"});
}

// A limit on file sizes makes a write fail midway, as a full disk does.
TEST_F(ProgramTest, AFullOutputLeavesNoPartialFile) {
  const auto limited = [](std::uint64_t bytes) { return ProcessOptions{.environment = {}, .largestFileBytes = bytes}; };
  // The first file, which says what is rendered, is smaller than that, and a frame is larger.
  expectFailure(walr({"render", WALR_SCENES "/box.gltf", "--tracer", "cpu", "--output", output.string(), "--frames",
                      "0-1", "--size", "64x36"},
                     limited(8192)),
                kOutput, {"noisy_0000.exr", "File too large"});
  EXPECT_EQ(outputFiles(), std::vector<std::string>{"render.json"});
  fs::remove_all(output);

  files.write(0, 1);
  const ProcessResult denoised = denoise({}, limited(200));
  // The software device of Mesa 25 keeps its memory in a file, for which the limit holds, too.
  if (denoised.exitCode == kDevice) {
    expectFailure(denoised, kDevice, {"memory lies in a file that cannot grow", "ulimit -f"});
  } else {
    expectFailure(denoised, kOutput, {"denoised_0000.exr", "File too large"});
  }
  EXPECT_TRUE(outputFiles().empty());
}

TEST_F(ProgramTest, AFullStandardOutputIsSaid) {
  for (const char* command : {"graph --json", "denoise --list-devices", "graph --list-passes", "--help"}) {
    const std::string line = std::string(WALR_PROGRAM " ") + command + " > /dev/full";
    expectFailure(test::runProcess({"/bin/sh", "-c", line}), kOutput, {"standard output"});
  }
}

TEST_F(ProgramTest, ReferencesThatNoFrameWouldGetAreRefused) {
  const auto expectUsage = [&](std::vector<std::string> more, std::initializer_list<std::string_view> parts) {
    std::vector<std::string> all = {
        "render", std::string(WALR_SCENES) + "/box.gltf", "--output", output.string(), "--size", "16x9"};
    all.insert(all.end(), more.begin(), more.end());
    test::expectFailure(walr(all), kUsage, parts);
    EXPECT_FALSE(fs::exists(output));
  };
  expectUsage({"--reference-frames", "5-6"}, {"--reference-frames", "--reference-spp"});
  expectUsage({"--reference-pixel", "area"}, {"--reference-pixel", "--reference-spp"});
  expectUsage({"--reference-one-square-in", "4"}, {"--reference-one-square-in", "--reference-spp"});
  expectUsage({"--tracer", "cpu", "--validate"}, {"--validate", "--tracer gpu"});
  expectUsage({"--frames", "0-4", "--reference-spp", "2", "--reference-frames", "5-6"},
              {"--reference-frames 5-6", "--frames 0-4"});
  // A loop over all frames would never end.
  expectUsage({"--frames", "2147483647-2147483647"}, {"--frames 2147483647-2147483647", "nine digits"});
}

TEST_F(ProgramTest, SettingsAtOddsAreAnErrorOfTheCommandLine) {
  expectFailure(walr({"graph", "--set", "accumulation.antilag-high=0"}), kUsage, {"--method walr", "antilag"});
}

TEST_F(ProgramTest, ANumberThatIsNoneIsRefused) {
  for (const char* speed : {"nan", "inf", "0", "-1", "24x"}) {
    expectFailure(walr({"render", WALR_SCENES "/box.gltf", "--output", output, "--fps", speed}), kUsage, {"--fps"});
  }
}

TEST_F(ProgramTest, AReportThatCannotBeWrittenIsNamed) {
  files.write(0, 0);
  expectFailure(denoise({"--json", (directory.path() / "nowhere" / "a.json").string()}), kOutput, {"a.json"});
}

constexpr const char* kChannels[] = {"DiffInd.R", "DiffInd.G", "DiffInd.B", "DiffCol.R", "DiffCol.G",
                                     "DiffCol.B", "Normal.X",  "Normal.Y",  "Normal.Z",  "Depth.Z",
                                     "Vector.X",  "Vector.Y",  "DiffDir.R", "Emit.B"};

/// Three pixels of a row that are not finite.
void breakRow(Image& plane, int row) {
  plane.at(10, row, 0) = std::numeric_limits<float>::quiet_NaN();
  plane.at(11, row, 0) = std::numeric_limits<float>::infinity();
  plane.at(3, row, 0) = -std::numeric_limits<float>::infinity();
}

TEST_F(ProgramTest, NonFiniteValuesAreRefusedByTheirChannel) {
  files.write(0, 1);
  for (const char* channel : kChannels) {
    files.writeFrame(0, [&](Channels& channels) { breakRow(channels.at(channel), 9); });
    expectFailure(denoise({"--composite", "--method", "none"}), kInput,
                  {"noisy_0000.exr", channel, "3 value(s)", "--non-finite replace"});
    EXPECT_TRUE(outputFiles().empty());
  }
}

// Each channel in other pixels, so that none hides what becomes of another one.
TEST_F(ProgramTest, NonFiniteValuesAreReplaced) {
  files.write(0, 1);
  for (const int frame : {0, 1}) {
    files.writeFrame(frame, [](Channels& channels) {
      int row = 1;
      for (const char* channel : kChannels) breakRow(channels.at(channel), row++);
    });
  }
  const ProcessResult result = denoise({"--composite", "--non-finite", "replace"});
  expectSuccess(result);
  for (const std::string channel : kChannels)
    fg::test::expectContains(result.err, {"3 non-finite value(s) in " + channel + " of noisy_0001.exr"});
  ExrReader reader(output / "denoised_0001.exr");
  Image image(reader.width(), reader.height(), 3);
  reader.read(std::vector<ExrReader::Target>{{"R", &image, 0}, {"G", &image, 1}, {"B", &image, 2}});
  expectFinite(image);
}

}  // namespace
}  // namespace walr
