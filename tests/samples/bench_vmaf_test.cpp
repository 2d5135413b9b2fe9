#include "samples/bench/vmaf.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "samples/errors.h"
#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"
#include "tests/shared_data.h"

namespace walr {
namespace {

namespace fs = std::filesystem;

constexpr fg::Extent kExtent{192, 108};

std::string readText(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class VmafTest : public testing::Test {
 protected:
  /// A substitute for ffmpeg. It prints the given help text, records its arguments, and writes a log of two frames to
  /// the path that results from the escaped `log_path`.
  [[nodiscard]] std::string standIn(const std::string& modelOption) const {
    const fs::path program = folder.path() / "stand-in";
    std::ofstream(program)
        << "#!/bin/sh\n"
           "case \"$*\" in\n"
           "*filter=libvmaf*) printf 'libvmaf AVOptions:\\n  " +
               modelOption +
               " <string> ..FV.....\\n' ;;\n"
               "*-version*) echo 'ffmpeg version 9.9 Copyright (c) somebody' ;;\n"
               "*) printf '%s' \"$*\" >> "
        << folder.path() / "calls"
        << "\n   log=$(printf '%s' \"$*\" | sed -n 's/.*log_path=\\([^ ]*\\) .*/\\1/p')\n"
           "   [ -z \"$log\" ] || "
           "echo '{\"frames\":[{\"metrics\":{\"vmaf\":97.5}},{\"metrics\":{\"vmaf\":42}}]}' > \"$log\";;\n"
           "esac\n";
    fs::permissions(program, fs::perms::owner_all);
    return program.string();
  }
  [[nodiscard]] std::string calls() const { return readText(folder.path() / "calls"); }

  test::TemporaryDirectory folder;
  std::string whyNot;
};

TEST_F(VmafTest, SaysWhyThereIsNone) {
  EXPECT_FALSE(VmafTool::find("/does/not/exist", {}, whyNot));
  EXPECT_NE(whyNot.find("'/does/not/exist' cannot be run; --ffmpeg"), std::string::npos) << whyNot;
  EXPECT_FALSE(VmafTool::find("true", {}, whyNot));
  EXPECT_NE(whyNot.find("'true' has no filter libvmaf; --ffmpeg"), std::string::npos) << whyNot;
}

TEST_F(VmafTest, TakesTheScoreOfEveryFrame) {
  const std::optional<VmafTool> tool = VmafTool::find(standIn("model_path"), {}, whyNot);
  ASSERT_TRUE(tool) << whyNot;
  EXPECT_EQ(tool->description(), "ffmpeg version 9.9, its own model");
  EXPECT_EQ(tool->scores(folder.path() / "a.rgb", folder.path() / "b.rgb", {40, 32}),
            (std::vector<double>{97.5, 42.0}));
  EXPECT_NE(calls().find("-pix_fmt rgb24 -s 40x32 -i file:" + (folder.path() / "b.rgb").string()), std::string::npos);
  EXPECT_FALSE(fs::exists(folder.path() / "a.rgb.json")) << "the log goes";
}

TEST_F(VmafTest, AFailureIsNamed) {
  const std::optional<VmafTool> tool = VmafTool::find(standIn("model_path"), {}, whyNot);
  ASSERT_TRUE(tool) << whyNot;
  std::ofstream(folder.path() / "stand-in") << "#!/bin/sh\necho first; echo no such clip >&2; exit 1\n";
  const auto scores = [&] { (void)tool->scores(folder.path() / "a.rgb", folder.path() / "b.rgb", {40, 32}); };
  fg::test::expectError<OutputError>(scores, {"says: no such clip"});
}

/// The option changed its name and format with libvmaf 2. A path may contain characters that separate options or
/// filters.
TEST_F(VmafTest, NamesTheModelAsTheVersionWants) {
  ASSERT_TRUE(VmafTool::find(standIn("model_path"), "a:b,c", whyNot)) << whyNot;
  EXPECT_NE(calls().find(R"(:model_path=a\\:b\,c )"), std::string::npos) << calls();
  ASSERT_TRUE(VmafTool::find(standIn("model"), "plain.json", whyNot)) << whyNot;
  EXPECT_NE(calls().find(":model=path=plain.json "), std::string::npos) << calls();
}

TEST_F(VmafTest, ClipsHoldWhatADisplayShows) {
  Image picture(2, 1, 3);
  picture.at(0, 0, 0) = 1.0F;
  picture.at(1, 0, 2) = 0.5F;
  const fs::path file = folder.path() / "clip.rgb";
  {
    Clip clip(file);
    clip.append(picture);
    clip.append(picture);
    // Half of the light is 188 of 255 on an sRGB display.
    const std::string frame("\xFF\0\0\0\0\xBC", 6);
    EXPECT_EQ(readText(clip.finished()), frame + frame);
  }
  EXPECT_FALSE(fs::exists(file)) << "a clip's file goes with it";
}

// A libvmaf without a model of its own takes that of the shared data.
using SharedDataVmaf = VmafTest;

/// Scores of the real libvmaf: identical clips score almost 100, a blurred clip less than half of that (42 on natural
/// clips with a blur of one pixel's standard deviation, libvmaf 3), and noise of 0.1 changes the score little.
TEST_F(SharedDataVmaf, ScoresAsLibvmafDoes) {
  const char* program = std::getenv("WALR_FFMPEG");
  const test::SharedData model("vmaf/vmaf_v0.6.1.pkl");
  std::optional<VmafTool> tool = VmafTool::find(program == nullptr ? "ffmpeg" : program, {}, whyNot);
  if (!tool && model) tool = VmafTool::find(program == nullptr ? "ffmpeg" : program, model.path(), whyNot);
  if (!tool) GTEST_SKIP() << whyNot << " (set WALR_FFMPEG to a program for this test)";
  const auto frame = [](int number, int blur, double noise) {
    Image image(kExtent.width, kExtent.height, 3);
    std::uint32_t state = 1;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        double sum = 0.0;
        for (int d = -blur; d <= blur; ++d) sum += ((x + d + number) / 6 + y / 6) % 2 == 0 ? 0.2 : 0.6;
        state = state * 747796405U + 2891336453U;
        const double value = sum / (2 * blur + 1) * (1.0 + noise * ((state >> 8U) * 0x1p-23 - 1.0));
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(value);
      }
    }
    return image;
  };
  const auto score = [&](int blur, double noise) {
    Clip test(folder.path() / "test.rgb");
    Clip reference(folder.path() / "reference.rgb");
    for (int number = 0; number < 4; ++number) {
      test.append(frame(number, blur, noise));
      reference.append(frame(number, 0, 0.0));
    }
    const std::vector<double> scores = tool->scores(test.finished(), reference.finished(), kExtent);
    EXPECT_EQ(scores.size(), 4U);
    return scores.back();
  };
  const double identical = score(0, 0.0);
  EXPECT_GT(identical, 95.0);
  EXPECT_LE(identical, 100.0);
  EXPECT_LT(score(4, 0.0), 0.5 * identical);
  EXPECT_GT(score(0, 0.1), 0.9 * identical);
}

}  // namespace
}  // namespace walr
