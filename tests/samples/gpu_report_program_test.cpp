#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/samples/process.h"
#include "tests/samples/schema_check.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

/// `walr gpu-report` as users call it, on Vulkan's processor driver.
namespace walr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::expectFailure;
using test::expectSuccess;
using test::ProcessResult;

using test::kDevice;
using test::kInput;
using test::kUsage;

class GpuReportProgramTest : public testing::Test {
 protected:
  [[nodiscard]] static ProcessResult report(const fs::path& output, const std::vector<std::string>& more,
                                            const test::ProcessOptions& options = {}) {
    std::vector<std::string> arguments = {WALR_PROGRAM, "gpu-report", "--quick", "--output", output.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProcess(arguments, options);
  }
  static json read(const fs::path& output) {
    const fs::path file = output / "gpu_report.json";
    EXPECT_EQ(test::schemaTroubles("samples/gpu_report/gpu_report.schema.json", file), "");
    return json::parse(test::readText(file));
  }
  static const json& agreement(const json& data, const std::string& variant, const std::string& sequence) {
    for (const json& entry : data["results"]["agreements"]) {
      if (entry["variant"] == variant && entry["sequence"] == sequence) return entry;
    }
    throw std::out_of_range(variant + " on " + sequence);
  }

  test::TemporaryDirectory directory;
  fs::path first = directory.path() / "first";
  fs::path second = directory.path() / "second";
};

TEST_F(GpuReportProgramTest, ValidatesTimesAndCompares) {
  expectSuccess(report(first, {"--methods", "walr,none", "--machine", "w6800"}));
  const json data = read(first);
  EXPECT_TRUE(data["validation"]["layer"]) << data["validation"];
  EXPECT_TRUE(data["validation"]["messages"].empty()) << data["validation"];
  EXPECT_EQ(data["validation"]["methods"], json({"walr", "none"}));
  EXPECT_TRUE(data["clocks"]["source"].is_null());

  ASSERT_EQ(data["bandwidth"]["probes"].size(), 6U);
  EXPECT_GT(data["bandwidth"]["probes"][0]["bytes_per_second"], 0.0);
  EXPECT_EQ(data["model"]["peak"]["bytes_per_second"], 512e9);
  double fastest = 0.0;
  for (const json& probe : data["bandwidth"]["probes"]) {
    if (!probe["bytes_per_second"].is_null()) fastest = std::max(fastest, probe["bytes_per_second"].get<double>());
  }
  EXPECT_EQ(data["model"]["attainable"]["bytes_per_second"], fastest);

  ASSERT_EQ(data["times"].size(), 2U);
  EXPECT_EQ(data["times"][0]["content"], "synthetic");
  EXPECT_EQ(data["times"][1]["content"], "scene");
  for (const json& times : data["times"]) {
    const json& walr = times["methods"][0];
    EXPECT_EQ(walr["timed_frames"], 3);
    EXPECT_GT(walr["passes"].size(), 5U);
    EXPECT_GT(walr["milliseconds"]["median"], 0.0);
    // 96 x 54 pixels, of which 8 bytes are read and written. So few threads take longer than their bytes.
    const json& pass = times["methods"][1]["passes"].at(0);
    EXPECT_EQ(pass["bytes"], 96.0 * 54.0 * 16.0);
    EXPECT_NEAR(pass["estimate"]["bytes"], 96.0 * 54.0 * 16.0 / 512e3, 1e-9);
    EXPECT_GE(pass["estimate"]["microseconds"], pass["estimate"]["bytes"]);
    EXPECT_EQ(times["methods"][1]["estimated_microseconds"], pass["estimate"]["microseconds"]);
  }

  for (const char* sequence : {"synthetic", "scene"}) {
    EXPECT_EQ(agreement(data, "walr", sequence)["rms_difference"], 0.0) << "the same device";
    EXPECT_FALSE(agreement(data, "walr", sequence)["suspicious"]);
    const double noisy = agreement(data, "none", sequence)["rmse"];
    EXPECT_LT(agreement(data, "walr", sequence)["rmse"], 0.5 * noisy) << sequence;
  }
  EXPECT_NE(test::readText(first / "gpu_report.md").find("**Estimates** are for AMD Radeon PRO W6800"),
            std::string::npos);
}

/// Without the validation layer, timestamps or enough memory, the rest goes on.
TEST_F(GpuReportProgramTest, SaysWhatIsMissing) {
  expectSuccess(report(first, {"--methods", "none"}));
  const test::ProcessOptions poor = {{{"VK_LAYER_PATH", WALR_LACKING_LAYER},
                                      {"VK_INSTANCE_LAYERS", "VK_LAYER_WALR_lacking"},
                                      {"WALR_TEST_LACKS", "timestamps"}},
                                     {}};
  expectSuccess(report(second, {"--methods", "none,accumulate", "--against", first.string()}, poor));
  const json data = read(second);
  EXPECT_FALSE(data["validation"]["layer"]);
  EXPECT_NE(data["validation"]["missing_because"].get<std::string>().find("vulkan-validationlayers"),
            std::string::npos);
  EXPECT_TRUE(data["device"]["timestamp_ns"].is_null());
  EXPECT_TRUE(data["bandwidth"]["probes"].empty());
  EXPECT_NE(data["model"]["missing_because"].get<std::string>().find("--machine"), std::string::npos);
  for (const json& times : data["times"]) {
    EXPECT_NE(times["methods"][0]["why_not"].get<std::string>().find("no timestamps"), std::string::npos);
  }
  EXPECT_EQ(agreement(data, "none", "scene")["rms_difference"], 0.0) << "the results of the first report";
  EXPECT_EQ(agreement(data, "none", "scene")["hash"], agreement(read(first), "none", "scene")["hash"]);
  EXPECT_NE(agreement(data, "accumulate", "scene")["why_not"].get<std::string>().find("scene_accumulate.exr"),
            std::string::npos);
}

TEST_F(GpuReportProgramTest, LeavesOutWhatIsTooLargeOrTooLate) {
  // To a software device, all of the machine's memory may be its own. These frames take 56 GiB there.
  test::ProcessOptions options;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // These take more addresses than that themselves.
  options.addressSpaceBytes = std::uint64_t{48} << 30U;
#endif
  expectSuccess(report(first, {"--methods", "none", "--sizes", "16384x16384,64x36"}, options));
  const json large = read(first);
  EXPECT_NE(large["times"][0]["methods"][0]["why_not"].get<std::string>().find("MiB of device memory"),
            std::string::npos);
  EXPECT_GT(large["times"][2]["methods"][0]["milliseconds"]["median"], 0.0) << "the next size";
  expectSuccess(report(second, {"--methods", "none", "--minutes", "0"}));
  const json late = read(second);
  EXPECT_FALSE(late["times"].empty());
  for (const json& times : late["times"]) {
    EXPECT_NE(times["methods"][0]["why_not"].get<std::string>().find("--minutes"), std::string::npos);
  }
}

TEST_F(GpuReportProgramTest, TakesASequence) {
  const fs::path input = directory.path() / "wall";
  fs::create_directory(input);
  test::SyntheticSequence(input, 40, 36).write(0, 3);
  expectSuccess(report(first, {"--methods", "accumulate", "--variant", "once=accumulate,accumulation.max-history=1",
                               "--sequence", input.string(), "--sizes", "64x36"}));
  const json data = read(first);
  EXPECT_EQ(data["times"][0]["content"], "sequence");
  EXPECT_EQ(data["times"][0]["width"], 40);
  EXPECT_GT(data["times"][0]["methods"][0]["milliseconds"]["median"], 0.0);
  EXPECT_EQ(agreement(data, "accumulate", "sequence")["rms_difference"], 0.0);
  EXPECT_EQ(data["times"][0]["methods"][1]["variant"], "once");
  EXPECT_NE(agreement(data, "once", "sequence")["hash"], agreement(data, "accumulate", "sequence")["hash"]);
}

TEST_F(GpuReportProgramTest, WhatIsWrongIsNamedBeforeAnythingIsWritten) {
  expectFailure(report(first, {"--methods", "magic"}), kUsage, {"magic"});
  expectFailure(report(first, {"--methods", "flr", "--variant", "flr=svgf"}), kUsage, {"'flr'"});
  expectFailure(report(first, {"--variant", "x=walr,magic=1"}), kUsage, {"magic"});
  expectFailure(report(first, {"--machine", "abacus"}), kUsage, {"'abacus'", "w6800", "h200"});
  expectFailure(report(first, {"--sizes", "64"}), kUsage, {"--sizes 64"});
  expectFailure(report(first, {"--against", (directory.path() / "nowhere").string()}), kUsage, {"nowhere"});
  expectFailure(report(directory.path(), {"--against", directory.path().string()}), kUsage, {"--output"});
  expectFailure(report(first, {"--sequence", (directory.path() / "nowhere").string()}), kInput, {"nowhere"});
  EXPECT_FALSE(fs::exists(first));
  expectFailure(report(first, {"--device", "abacus"}), kDevice, {"abacus"});
}

}  // namespace
}  // namespace walr
