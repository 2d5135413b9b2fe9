// The host in C++17 (samples/embedding/sequence.cpp) writes what `walr denoise` writes.
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

constexpr int kFrames = 5;
constexpr int kMostLines = 200;

class EmbeddingTest : public testing::Test {
 protected:
  /// Render the first frames of a sequence in which the camera moves.
  void render(const fs::path& folder, int first, int last) const {
    test::expectSuccess(test::runProcess({WALR_PROGRAM, "render", WALR_SCENE, "--output", folder.string(), "--frames",
                                          std::to_string(first) + "-" + std::to_string(last), "--size", "72x48",
                                          "--spp", "1", "--jitter"}));
  }
  /// The program under the validation layer, which writes its messages to the standard output.
  static test::ProcessResult run(const std::vector<std::string>& arguments) {
    std::vector<std::string> all{WALR_SEQUENCE_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return test::runProcess(
        all, {.environment = {{"VK_INSTANCE_LAYERS", "VK_LAYER_KHRONOS_validation"},
                              {"VK_LAYER_ENABLES", "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT"},
                              {"VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC", "true"},  // From 1.4 of the layer on.
                              // Newer layers warn that VK_LAYER_ENABLES is deprecated.
                              {"VK_LAYER_MESSAGE_ID_FILTER", "VALIDATION-SETTINGS"}},
              .largestFileBytes = {}});
  }

  test::TemporaryDirectory directory_;
};

TEST_F(EmbeddingTest, WritesTheFilesOfWalrDenoise) {
  const fs::path in = directory_.path() / "in";
  const fs::path expected = directory_.path() / "expected";
  const fs::path out = directory_.path() / "out";
  render(in, 3, 3 + kFrames - 1);  // The numbers of frames are seeds of their random numbers.
  test::expectSuccess(test::runProcess({WALR_PROGRAM, "denoise", in.string(), "--output", expected.string()}));
  const test::ProcessResult result = run({in.string(), out.string()});
  test::expectSuccess(result);
  EXPECT_EQ(result.out, "");
  int compared = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(out)) {
    EXPECT_TRUE(test::readText(file.path()) == test::readText(expected / file.path().filename())) << file.path();
    ++compared;
  }
  EXPECT_EQ(compared, kFrames);
}

TEST_F(EmbeddingTest, ReportsItsErrors) {
  test::expectFailure(run({}), 1, {"usage: walr-sequence IN OUT"});
  test::expectFailure(run({directory_.path().string(), (directory_.path() / "out").string()}), 1, {"holds no frames"});
  test::expectFailure(run({"/nowhere", (directory_.path() / "out").string()}), 1, {"/nowhere"});
}

TEST_F(EmbeddingTest, IsShort) {
  const std::string text = test::readText(WALR_SEQUENCE_SOURCE);
  EXPECT_LE(std::ranges::count(text, '\n'), kMostLines);
}

}  // namespace
}  // namespace walr
