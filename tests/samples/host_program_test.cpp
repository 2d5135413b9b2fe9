// `walr-host` as users call it: exit codes, messages, files.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/samples/process.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr {
namespace {

namespace fs = std::filesystem;

using test::kInput;
using test::kOutput;
using test::kUsage;

class HostProgramTest : public testing::Test {
 protected:
  [[nodiscard]] test::ProcessResult host(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {WALR_HOST_PROGRAM, "--headless", "--validate", "--size", "36x20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProcess(arguments);
  }
  [[nodiscard]] std::vector<std::string> outputFiles() const { return test::namesIn(output); }

  test::TemporaryDirectory folder;
  fs::path output = folder.path() / "out";
  std::string scene = WALR_SCENES "/turntable.gltf";
};

TEST_F(HostProgramTest, WritesAPictureAFrame) {
  const test::ProcessResult result = host({scene, "-o", output.string(), "--frames", "11-13", "--exr", "--method",
                                           "walr_paper", "--set", "regression.iterations=2"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(outputFiles(), (std::vector<std::string>{"frame_0011.exr", "frame_0011.png", "frame_0012.exr",
                                                     "frame_0012.png", "frame_0013.exr", "frame_0013.png"}));
  EXPECT_NE(result.out.find(" million rays/s\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" MiB of the frame graph\n"), std::string::npos) << result.out;
  // Its settings are not those of any preset.
  EXPECT_NE(result.out.find("method: walr_paper\n"), std::string::npos) << result.out;
}

TEST_F(HostProgramTest, NamesThePresetInUse) {
  const std::vector<std::string> once = {scene, "-o", output.string(), "--frames", "0-0"};
  EXPECT_NE(host(once).out.find("method: walr, preset standard\n"), std::string::npos);
  std::vector<std::string> chosen = once;
  chosen.insert(chosen.end(), {"--method", "svgf", "--preset", "paper"});
  EXPECT_NE(host(chosen).out.find("method: svgf, preset paper\n"), std::string::npos);
}

TEST_F(HostProgramTest, TracesAndDenoisesSparseLight) {
  for (const char* rate : {"1/2", "1/4", "1/9"}) {
    const test::ProcessResult result =
        host({scene, "-o", output.string(), "--frames", "11-13", "--light-rate", rate, "--jitter", "--view", "split"});
    EXPECT_EQ(result.exitCode, 0) << rate << result.err;
  }
  test::expectFailure(host({scene, "-o", output.string(), "--light-rate", "1/4", "--method", "svgf"}), kUsage,
                      {"method 'svgf'"});
}

TEST_F(HostProgramTest, ResamplesLight) {
  const auto last = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{scene, "-o", output.string(), "--frames", "11-14", "--method", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ProcessResult result = host(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return test::readText(output / "frame_0014.png");
  };
  const std::string plain = last({});
  EXPECT_NE(last({"--resampled-frames", "20"}), plain);
  EXPECT_EQ(last({"--resampled-frames", "0"}), plain);
  const test::ProcessResult automatic =
      host({scene, "-o", output.string(), "--frames", "0-0", "--resampled-frames", "20"});
  EXPECT_NE(automatic.out.find("tracer: CPU (Embree), because the GPU's path tracer has no --resampled-frames\n"),
            std::string::npos)
      << automatic.out;
}

TEST_F(HostProgramTest, ShowsSpecularLightAndWhatMirrorsShow) {
  const auto write = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{WALR_SCENES "/gloss.gltf", "--camera", "mirror", "-o", output.string()};
    arguments.insert(arguments.end(), {"--frames", "0-0", "--exposure", "0"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const test::ProcessResult result = host(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return test::readText(output / "frame_0000.png");
  };
  const std::string specular = write({"--specular"});
  EXPECT_NE(specular, write({}));
  EXPECT_NE(specular, write({"--specular", "--replace-mirrors"}));
}

TEST_F(HostProgramTest, ComparesTwoMethods) {
  const fs::path alone = folder.path() / "alone";
  const std::vector<std::string> frames = {scene, "--frames", "11-12"};
  const auto write = [&](const fs::path& directory, std::vector<std::string> more) {
    more.insert(more.end(), frames.begin(), frames.end());
    more.insert(more.end(), {"-o", directory.string()});
    const test::ProcessResult result = host(more);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return test::readText(directory / "frame_0012.png");
  };
  const std::string both = write(output, {"--compare", "svgf:paper"});
  EXPECT_NE(both, write(alone, {}));
  EXPECT_NE(both, write(alone, {"--compare", "svgf"}));
  EXPECT_EQ(write(alone, {"--view", "compare"}), write(alone, {"--compare", "none"}));
}

TEST_F(HostProgramTest, RefusesCommandLinesWithoutMeaning) {
  const auto expectUsage = [&](const std::vector<std::string>& arguments, const std::string& named) {
    test::expectFailure(host(arguments), kUsage, {named});
  };
  expectUsage({scene, "--record", output.string() + "/host.gif"}, ".webp");
  expectUsage({scene, "-o", output.string(), "--exposure", "bright"}, "--exposure bright");
  expectUsage({scene}, "--output");
  expectUsage({scene, "--record", output.string() + "/host.webp", "--exr"}, "--exr: EXR files are written to a folder");
  expectUsage({scene, "-o", output.string(), "--frames", "0-1000000000"}, "up to nine digits");
  expectUsage({scene, "-o", output.string(), "--target-ms", "16"}, "--target-ms");
  expectUsage({scene, "-o", output.string(), "--once"}, "--once");
  expectUsage({scene, "-o", output.string(), "--seed", "2147483648"}, "--seed");
  expectUsage({scene, "-o", output.string(), "--frames", "3-1"}, "--frames 3-1");
  expectUsage({scene, "-o", output.string(), "--set", "nothing=1"}, "nothing");
  expectUsage({scene, "-o", output.string(), "--compare", "nothing"}, "--compare nothing");
  expectUsage({scene, "-o", output.string(), "--compare", "walr:nothing"}, "--compare walr:nothing");
  expectUsage({scene, "-o", output.string(), "--compare", "svgf", "--view", "noisy"}, "--compare");
  expectUsage({scene, "-o", output.string(), "--light-rate", "1/3"}, "--light-rate");
  expectUsage({scene, "-o", output.string(), "--light-rate", "1/4", "--resampled-frames", "20"}, "--resampled-frames");
  expectUsage({scene, "-o", output.string(), "--tracer", "gpu", "--resampled-frames", "20"}, "--tracer cpu");
  expectUsage({scene, "-o", output.string(), "--replace-mirrors"}, "--specular");
  expectUsage({scene, "-o", output.string(), "--specular", "--light-rate", "1/4"}, "--light-rate");
  expectUsage({scene, "-o", output.string(), "--specular", "--resampled-frames", "20"}, "--resampled-frames");
  expectUsage({scene, "-o", output.string(), "--resampled-frames", "1001"}, "--resampled-frames");
  expectUsage({scene, "-o", output.string(), "--view", "nothing"}, "'guides.depth.current'");
  EXPECT_FALSE(fs::exists(output));
}

TEST_F(HostProgramTest, RecordsTheSceneThatComesWithItAsAnAnimation) {
  const fs::path file = output / "host.webp";
  const test::ProcessResult result = host({"--record", file.string(), "--frames", "0-2"});
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_EQ(outputFiles(), std::vector<std::string>{"host.webp"});
  const std::string contents = test::readText(file);
  EXPECT_EQ(contents.substr(0, 4) + contents.substr(8, 4), "RIFFWEBP");
  // The chunk of an animation's frame occurs once for each of them: the camera moves in every frame.
  std::size_t frames = 0;
  for (std::size_t at = contents.find("ANMF"); at != std::string::npos; at = contents.find("ANMF", at + 4)) ++frames;
  EXPECT_EQ(frames, 3U);
}

TEST_F(HostProgramTest, NamesTheSceneThatCannotBeRead) {
  const fs::path broken = folder.path() / "broken.glb";
  test::writeText(broken, "glTF");
  test::expectFailure(host({broken.string(), "-o", output.string()}), kInput, {broken.string()});
}

TEST_F(HostProgramTest, NamesAFileThatCannotBeWrittenBeforeItRenders) {
  const fs::path taken = folder.path() / "taken.webp";
  fs::create_directory(taken);
  const test::ProcessResult result = host({scene, "--record", taken.string()});
  test::expectFailure(result, kOutput, {taken.string()});
  EXPECT_EQ(result.err.find("frame 1"), std::string::npos) << result.err;
}

TEST_F(HostProgramTest, NamesAFolderThatCannotBeMade) {
  test::writeText(output, "a file");
  test::expectFailure(host({scene, "-o", output.string()}), kOutput, {output.string()});
}

}  // namespace
}  // namespace walr
