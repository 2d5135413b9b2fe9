#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samples/sequence/writer.h"
#include "tests/samples/process.h"
#include "tests/samples/schema_check.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

/// `walr bench` as users call it.
namespace walr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::expectFailure;
using test::expectSuccess;
using test::ProcessResult;

class BenchProgramTest : public testing::Test {
 protected:
  BenchProgramTest() {
    fs::create_directory(input);
    test::SyntheticSequence(input, 40, 36).write(0, 5);
  }

  /// Run `walr bench` under the validation layer: with one repetition unless the arguments set another number, and
  /// without report.html unless requested.
  [[nodiscard]] ProcessResult bench(const fs::path& output, std::vector<std::string> more, bool page = false) const {
    std::vector<std::string> arguments = {WALR_PROGRAM, "bench",         "--sequences", input.string(),
                                          "--output",   output.string(), "--validate"};
    if (!page) more.emplace_back("--no-html");
    if (std::ranges::find(more, "--repeat") == more.end()) more.insert(more.end(), {"--repeat", "1"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProcess(arguments);
  }
  static json report(const fs::path& output) {
    EXPECT_EQ(test::schemaTroubles("samples/bench/bench.schema.json", output / "bench.json"), "");
    return json::parse(test::readText(output / "bench.json"));
  }
  static json run(const json& report, const std::string& variant) {
    for (const json& run : report["sequences"][0]["runs"]) {
      if (run["variant"] == variant) return run;
    }
    return {};
  }

  test::TemporaryDirectory directory;
  fs::path input = directory.path() / "wall";
  fs::path first = directory.path() / "first";
  fs::path second = directory.path() / "second";
};

TEST_F(BenchProgramTest, MeasuresMethodsBesideEachOther) {
  const ProcessResult result = bench(
      first, {"--methods", "accumulate,none", "--variant", "off=walr_paper:robust,regression.replace-taps=off"}, true);
  expectSuccess(result);
  EXPECT_NE(result.out.find("\noff "), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("frame 12 of 12"), std::string::npos) << result.err;

  const json data = report(first);
  EXPECT_FALSE(data["commit"].get<std::string>().empty());
  EXPECT_FALSE(data["device"]["driver"].get<std::string>().empty());
  EXPECT_GT(data["device"]["timestamp_ns"], 0.0);
  ASSERT_EQ(data["variants"].size(), 4U);
  EXPECT_EQ(data["variants"][0]["name"], "walr");
  EXPECT_EQ(data["variants"][3]["name"], "off");
  EXPECT_EQ(data["variants"][3]["settings"]["regression.replace-taps"], "off");
  const json walr = run(data, "walr");
  EXPECT_TRUE(walr["reproducible"]);
  EXPECT_EQ(walr["timed_frames"], 6);
  EXPECT_EQ(walr["ratio"]["median"], 1.0);
  ASSERT_EQ(walr["frames"].size(), 6U);
  EXPECT_TRUE(walr["frames"][0]["flicker"].is_null()) << "the first frame has none before it";
  // The reference is constant, so a denoiser's error must be far below that of one sample per pixel.
  EXPECT_LT(walr["mean_after_4"]["rmse"].get<double>(), 0.25 * run(data, "none")["mean_after_4"]["rmse"].get<double>());
  EXPECT_LT(walr["mean_after_4"]["flicker"].get<double>(), run(data, "none")["mean_after_4"]["flicker"].get<double>());
  EXPECT_GT(walr["passes"].size(), 3U);
  for (const char* file :
       {"bench.csv", "report.html", "report.py", "report_data.py", "report_plots.py", "pareto.svg"}) {
    EXPECT_TRUE(fs::exists(first / file)) << file << ": " << result.out;
  }
  const std::string table = test::readText(first / "bench.csv");
  EXPECT_TRUE(table.starts_with("sequence,variant,rmse,worst_rmse,")) << table;
  EXPECT_NE(table.find("\nwall,off,0."), std::string::npos) << table;
  EXPECT_EQ(std::ranges::count(table, '\n'), 5) << "a header and four variants";
  const std::string page = test::readText(first / "report.html");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "the page must hold all that it shows";
}

// The folder holds finished runs with all samples, which must not be taken for runs with some of them.
TEST_F(BenchProgramTest, ComparesWithAShareOfTheSamples) {
  expectSuccess(bench(first, {"--methods", "accumulate"}));
  const double all = run(report(first), "accumulate")["mean"]["rmse"];
  expectSuccess(bench(first, {"--methods", "accumulate", "--light-rate", "1/4"}));
  EXPECT_GT(run(report(first), "accumulate")["mean"]["rmse"].get<double>(), all);
}

TEST_F(BenchProgramTest, RefusesMethodsThatDoNotTakeSparseLight) {
  expectFailure(bench(first, {"--light-rate", "1/4"}), test::kUsage, {"wall", "sample of light", "flr", "--methods"});
  EXPECT_FALSE(fs::exists(first));
}

TEST_F(BenchProgramTest, RunsGiveTheSameErrorsAndPictures) {
  expectSuccess(bench(first, {"--methods", "bmfr"}));
  expectSuccess(bench(second, {"--methods", "bmfr"}));
  const json a = report(first);
  const json b = report(second);
  for (const char* variant : {"walr", "bmfr"}) {
    EXPECT_EQ(run(a, variant)["frames"], run(b, variant)["frames"]);
    const fs::path picture = fs::path("pictures") / "wall" / (std::string(variant) + "_0005.npy");
    EXPECT_EQ(test::readText(first / picture), test::readText(second / picture));
  }
}

TEST_F(BenchProgramTest, KeepsThePicturesOfAllFramesWithReferencesIfAsked) {
  const auto kept = [](const fs::path& output, const std::string& name) {
    std::size_t count = 0;
    for (int frame = 0; frame < 6; ++frame) {
      const std::string file = name + "_000" + std::to_string(frame) + ".npy";
      count += fs::exists(output / "pictures" / "wall" / file) ? 1 : 0;
    }
    return count;
  };
  expectSuccess(bench(first, {"--methods", "none"}));
  for (const char* name : {"none", "_reference", "_age"}) EXPECT_LE(kept(first, name), 2U) << name;
  // Kept runs lack the pictures, so that they are run again. Errors without times are the same.
  expectSuccess(bench(first, {"--methods", "none", "--all-pictures"}));
  expectSuccess(bench(second, {"--methods", "none", "--all-pictures", "--repeat", "0"}));
  for (const fs::path& output : {first, second}) {
    for (const char* name : {"none", "none.errors", "walr", "_reference", "_noisy", "_age"}) {
      EXPECT_EQ(kept(output, name), 6U) << name;
    }
  }
  const json untimed = run(report(second), "none");
  EXPECT_EQ(untimed["frames"], run(report(first), "none")["frames"]);
  EXPECT_EQ(untimed["timed_frames"], 0);
  EXPECT_TRUE(untimed["milliseconds"].is_null());

  // The camera of the sequence moves, so that the first frame is new everywhere, and later ones are mostly old.
  const auto ages = [&](int frame) {
    const std::string bytes =
        test::readText(first / "pictures" / "wall" / ("_age_000" + std::to_string(frame) + ".npy"));
    std::vector<std::uint16_t> halves(std::size_t{40} * 36);
    std::memcpy(halves.data(), bytes.data() + bytes.size() - 2 * halves.size(), 2 * halves.size());
    return halves;
  };
  const std::vector<std::uint16_t> start = ages(0);
  EXPECT_TRUE(std::ranges::all_of(start, [](std::uint16_t half) { return half == 0; }));
  constexpr std::uint16_t kThree = 0x4200;  // 3 as a half float.
  const std::vector<std::uint16_t> fourth = ages(3);
  EXPECT_GT(std::ranges::count(fourth, kThree), 40 * 36 / 2);
  EXPECT_TRUE(std::ranges::all_of(fourth, [](std::uint16_t half) { return half <= kThree; }));
}

TEST_F(BenchProgramTest, RunsOnlyWhatIsMissingOrHasChanged) {
  expectSuccess(bench(first, {"--methods", "accumulate"}));
  const json before = report(first);
  const ProcessResult again = bench(first, {"--methods", "accumulate"});
  expectSuccess(again);
  EXPECT_NE(again.err.find("2 of 2 variants have been run already"), std::string::npos) << again.err;
  EXPECT_EQ(report(first)["sequences"], before["sequences"]);

  const ProcessResult more = bench(first, {"--methods", "accumulate,none"});
  EXPECT_NE(more.err.find("2 of 3 variants"), std::string::npos) << more.err;
  EXPECT_EQ(run(report(first), "accumulate"), run(before, "accumulate"));

  test::SyntheticSequence(input, 40, 36).writeReference(3, [](test::Channels& channels) {
    channels.at("DiffInd.R").at(20, 20, 0) += 0.5F;
  });
  const ProcessResult changed = bench(first, {"--methods", "accumulate"});
  EXPECT_NE(changed.err.find("0 of 2 variants"), std::string::npos) << changed.err;
  json cameras = json::parse(test::readText(input / "cameras.json"));
  cameras["frames"][3]["jitter"] = {0.25, -0.25};
  test::writeText(input / "cameras.json", cameras.dump());
  const ProcessResult jittered = bench(first, {"--methods", "accumulate"});
  EXPECT_NE(jittered.err.find("0 of 2 variants"), std::string::npos) << jittered.err;
  const ProcessResult found = bench(first, {"--methods", "accumulate", "--motion-depth", "found"});
  expectSuccess(found);
  EXPECT_NE(found.err.find("0 of 2 variants"), std::string::npos) << found.err;
}

// The distances and roughness of Cycles' glossy light are in a file beside the frame.
TEST_F(BenchProgramTest, RunsAgainWhereTheFileOfDistancesHasChanged) {
  const auto fill = [](test::Channels& channels, const std::string& plane, float value) {
    for (const char component : {'R', 'G', 'B'}) {
      Image& image = channels[plane + "." + component] = Image(40, 36, 1);
      std::ranges::fill(image.values(), value);
    }
  };
  const auto gloss = [&](test::Channels& channels) {
    for (const char* const plane : {"GlossDir", "GlossInd", "GlossCol"}) fill(channels, plane, 0.5F);
  };
  const test::SyntheticSequence files(input, 40, 36);
  const auto writeRoughness = [&](float roughness) {
    test::Channels sums;
    for (const char* const plane : {"GlossDir", "Emit"}) fill(sums, plane, 1.0F);
    std::ranges::fill(sums.at("GlossDir.R").values(), roughness);
    test::writeChannels(input / "specular_0000.exr", sums);
  };
  files.writeFrame(0, gloss);
  files.writeReference(0, gloss);
  writeRoughness(0.5F);
  const auto run = [&] { return bench(first, {"--methods", "none", "--light", "specular", "--frames", "0-0"}).err; };
  EXPECT_NE(run().find("0 of 2 variants"), std::string::npos);
  EXPECT_NE(run().find("2 of 2 variants"), std::string::npos);
  writeRoughness(0.75F);
  EXPECT_NE(run().find("0 of 2 variants"), std::string::npos);
}

/// References are expensive. Frames without one are run as well, but have no errors.
TEST_F(BenchProgramTest, MeasuresTheFramesThatHaveAReference) {
  expectSuccess(bench(first, {"--methods", "accumulate"}));
  const json whole = run(report(first), "accumulate");
  fs::remove(input / "ref_0003.exr");
  fs::remove(input / "ref_0005.exr");
  expectSuccess(bench(second, {"--methods", "accumulate"}, true));
  const json data = report(second);
  const json part = run(data, "accumulate");
  ASSERT_EQ(part["frames"].size(), 6U);
  for (const int frame : {0, 1, 2}) EXPECT_EQ(part["frames"][frame], whole["frames"][frame]);
  for (const char* metric : {"rmse", "ssim", "flip", "flicker"}) EXPECT_TRUE(part["frames"][3][metric].is_null());
  EXPECT_EQ(part["frames"][4]["rmse"], whole["frames"][4]["rmse"]);
  EXPECT_TRUE(part["frames"][4]["flicker"].is_null()) << "there is no error before it to change";
  EXPECT_EQ(part["mean_after_4"]["rmse"], whole["frames"][4]["rmse"]);
  EXPECT_EQ(data["sequences"][0]["picture_frames"], json({4}));
  EXPECT_TRUE(fs::exists(second / "report.html"));
}

/// The times of one method under two names differ by less than the reported spread.
TEST_F(BenchProgramTest, AMethodIsAsFastAsItself) {
  expectSuccess(bench(first, {"--methods", "walr", "--variant", "again=walr", "--repeat", "5"}));
  const json data = report(first);
  const json again = run(data, "again");
  EXPECT_EQ(again["frames"], run(data, "walr")["frames"]);
  const json& ratio = again["ratio"];
  EXPECT_LE(std::abs(ratio["median"].get<double>() - 1.0), ratio["p95"].get<double>() - ratio["p5"].get<double>());
}

/// Two runs agree: methods whose spreads do not overlap have the same order in both, and the median of a part of a
/// method is below that of the whole.
TEST_F(BenchProgramTest, TwoRunsAgreeInRanking) {
  const std::vector<std::string> methods = {"none", "accumulate", "walr", "joint_bilateral", "svgf", "flr"};
  std::string list;
  for (const std::string& method : methods) list += (list.empty() ? "" : ",") + method;
  std::vector<json> runs;
  for (const fs::path& output : {first, second}) {
    expectSuccess(bench(output, {"--methods", list, "--repeat", "4"}));
    runs.push_back(report(output));
  }
  const auto faster = [](const json& data, const std::string& a, const std::string& b) {
    return run(data, a)["ratio"]["p95"].get<double>() < run(data, b)["ratio"]["p5"].get<double>();
  };
  for (const std::string& a : methods) {
    for (const std::string& b : methods) EXPECT_FALSE(faster(runs[0], a, b) && faster(runs[1], b, a)) << a << ", " << b;
  }
  for (const json& data : runs) {
    const auto median = [&](const char* method) { return run(data, method)["ratio"]["median"].get<double>(); };
    EXPECT_LT(median("none"), median("accumulate"));
    EXPECT_LT(median("accumulate"), median("walr"));
  }
}

TEST_F(BenchProgramTest, WhatIsWrongIsNamedBeforeAnythingIsWritten) {
  using test::kInput;
  using test::kUsage;
  expectFailure(bench(first, {"--methods", "magic"}), kUsage, {"magic"});
  expectFailure(bench(first, {"--variant", "x=walr,magic=1"}), kUsage, {"magic"});
  expectFailure(bench(first, {"--sequences", (directory.path() / "nowhere").string()}), kInput, {"nowhere"});
  const fs::path sparse = directory.path() / "sparse";
  fs::create_directory(sparse);
  Frame frame = test::projectFrame(0, 40, 36);
  frame.light = {.columns = 2, .rows = 2};
  writeFrame(sparse, frame);
  writeReference(sparse, 0, {.indirect = frame.indirect});
  expectFailure(bench(first, {"--sequences", sparse.string()}), kInput, {"'sparse'", "sample of light"});
  for (int frame = 0; frame < 6; ++frame) fs::remove(input / ("ref_000" + std::to_string(frame) + ".exr"));
  expectFailure(bench(first, {}), kInput, {"no frame has a reference"});
  EXPECT_FALSE(fs::exists(first));
}

TEST_F(BenchProgramTest, SaysWhyThereIsNoPage) {
  const ProcessResult result = bench(first, {"--methods", "none", "--python", "/does/not/exist"}, true);
  expectSuccess(result);
  EXPECT_NE(result.out.find("python3-matplotlib"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(first / "bench.json"));
}

}  // namespace
}  // namespace walr
