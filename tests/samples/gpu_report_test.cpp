#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "samples/gpu_report/agreement.h"
#include "samples/gpu_report/clocks.h"
#include "samples/gpu_report/gpu_report_page.h"
#include "samples/gpu_report/machine_memory.h"
#include "samples/gpu_report/method_times.h"
#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"

namespace walr {
namespace {

namespace fs = std::filesystem;
using test::TemporaryDirectory;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(MachineMemory, IsWhatTheKernelCallsAvailable) {
  const TemporaryDirectory folder;
  write(folder.path() / "meminfo",
        "MemTotal:       24731748 kB\nMemFree: 7 kB\nMemAvailable:        3 kB\nBuffers: 9 kB\n");
  EXPECT_EQ(freeMachineMemory(folder.path() / "meminfo"), 3 * 1024);
  write(folder.path() / "other", "MemTotal: 1 kB\n");
  EXPECT_FALSE(freeMachineMemory(folder.path() / "other").has_value());
  EXPECT_FALSE(freeMachineMemory(folder.path() / "absent").has_value());
}

TEST(MachineMemory, HoldsWhatADeviceSharesWithIt) {
  constexpr double kMebi = 1U << 20U;
  const MemoryNeeded needed{.making = 40 * kMebi, .machine = 20 * kMebi, .device = 30 * kMebi};
  const auto text = [&](MemoryThere there) { return whyTooLarge(needed, there); };
  EXPECT_EQ(text({.device = 29 * kMebi, .shared = false, .machine = 99 * kMebi}),
            "needs 30 MiB of device memory, and the device has 29 MiB");
  EXPECT_EQ(text({.device = 30 * kMebi, .shared = false, .machine = 40 * kMebi}), "");
  EXPECT_EQ(text({.device = 30 * kMebi, .shared = false, .machine = 39 * kMebi}),
            "needs 40 MiB of the machine's memory, of which 39 MiB are free");
  EXPECT_EQ(text({.device = 99 * kMebi, .shared = true, .machine = 50 * kMebi}), "");
  EXPECT_EQ(
      text({.device = 99 * kMebi, .shared = true, .machine = 49 * kMebi}),
      "needs 30 MiB of device memory and 20 MiB beside it, both of the machine's memory, of which 49 MiB are free");
  EXPECT_EQ(text({.device = 99 * kMebi, .shared = true, .machine = std::nullopt}), "");
}

TEST(Clocks, AreThoseOfTheNamedLineOfNvidiaSmi) {
  const std::string lines = "NVIDIA H200 NVL, 345, 100\nNVIDIA H200, 1980, 3201\nNVIDIA T4, [N/A], 405\n";
  EXPECT_EQ(parseNvidiaSmi(lines, "NVIDIA H200")->coreMegahertz, 1980.0);
  EXPECT_EQ(parseNvidiaSmi(lines, "NVIDIA H200")->memoryMegahertz, 3201.0);
  EXPECT_FALSE(parseNvidiaSmi(lines, "NVIDIA T4")->coreMegahertz.has_value());
  EXPECT_EQ(parseNvidiaSmi(lines, "NVIDIA T4")->memoryMegahertz, 405.0);
  EXPECT_FALSE(parseNvidiaSmi(lines, "NVIDIA A100").has_value());
  EXPECT_FALSE(parseNvidiaSmi("", "NVIDIA A100").has_value());
}

TEST(Clocks, AreThoseOfTheLevelThatAmdgpuMarks) {
  EXPECT_EQ(parseCurrentLevel("0: 500Mhz\n1: 2300Mhz *\n"), 2300.0);
  EXPECT_FALSE(parseCurrentLevel("0: 500Mhz\n1: 2300Mhz\n").has_value());
  EXPECT_FALSE(parseCurrentLevel("").has_value());
}

TEST(Clocks, AreReadFromTheCardWithTheDevicesNumbers) {
  const TemporaryDirectory sysfs;
  write(sysfs.path() / "card0" / "device" / "vendor", "0x8086\n");
  write(sysfs.path() / "card0" / "device" / "device", "0x4680\n");
  write(sysfs.path() / "card0" / "gt_act_freq_mhz", "1450\n");
  write(sysfs.path() / "card1" / "device" / "vendor", "0x1002\n");
  write(sysfs.path() / "card1" / "device" / "device", "0x73a3\n");
  write(sysfs.path() / "card1" / "device" / "pp_dpm_sclk", "0: 500Mhz *\n1: 2555Mhz\n");
  write(sysfs.path() / "card1" / "device" / "pp_dpm_mclk", "0: 96Mhz\n1: 1000Mhz *\n");

  const ClockReader amd(0x1002, 0x73a3, "AMD Radeon PRO W6800", sysfs.path());
  EXPECT_EQ(amd.source(), (sysfs.path() / "card1").string());
  EXPECT_EQ(amd.read()->coreMegahertz, 500.0);
  EXPECT_EQ(amd.read()->memoryMegahertz, 1000.0);
  const ClockReader intel(0x8086, 0x4680, "Intel", sysfs.path());
  EXPECT_EQ(intel.read()->coreMegahertz, 1450.0);
  EXPECT_FALSE(intel.read()->memoryMegahertz.has_value());

  const ClockReader other(0x1002, 0x1234, "another card", sysfs.path());
  EXPECT_FALSE(other.read().has_value());
  EXPECT_TRUE(other.source().empty());
  EXPECT_NE(other.whyNot().find(sysfs.path().string()), std::string::npos) << other.whyNot();
  const ClockReader processor(0x10005, 0, "llvmpipe", sysfs.path());
  EXPECT_FALSE(processor.whyNot().empty());
}

TEST(AgreementTest, IsSuspiciousBeyondATenthOfTheMethodsOwnError) {
  Agreement agreement;
  EXPECT_FALSE(agreement.suspicious()) << "nothing to compare with";
  agreement.referenceRmse = 0.02;
  agreement.rmsDifference = 0.0019;
  EXPECT_FALSE(agreement.suspicious());
  agreement.rmsDifference = 0.0021;
  EXPECT_TRUE(agreement.suspicious());
  agreement.rmsDifference = 0.0;
  agreement.nonFinite = 1;
  EXPECT_TRUE(agreement.suspicious());
}

TEST(MethodTimesTest, EstimateIsTheSumOfTheLargestBounds) {
  MethodTimes times;
  EXPECT_FALSE(times.estimatedMicroseconds().has_value()) << "no passes";
  times.models = {{.bytes = 1.0, .peak = Bounds{.bytes = 3.0, .fetches = 2.0}, .attainable = {}},
                  {.batch = 1, .bytes = 1.0, .peak = Bounds{.instructions = 4.0, .latency = 5.0}, .attainable = {}}};
  EXPECT_EQ(times.estimatedMicroseconds(), 8.0);
  times.models[1].peak.reset();
  EXPECT_FALSE(times.estimatedMicroseconds().has_value());
}

TEST(MethodTimesTest, IsUnsteadyBeyondOneAndAHalfTimesTheMedian) {
  MethodTimes times;
  EXPECT_FALSE(times.unsteady()) << "no times";
  times.timing.milliseconds = Spread{2.0, 1.0, 3.0};
  EXPECT_FALSE(times.unsteady());
  times.timing.milliseconds->p95 = 3.1;
  EXPECT_TRUE(times.unsteady());
}

GpuReport smallReport() {
  GpuReport report;
  report.device.name = "Abacus 9000";
  report.whyNoMachine = "it has beads";
  report.whyNoClocks = "it has none";
  report.validation.whyNot = "no layer";
  report.whyNoReference = "no processor";
  MethodTimes timed;
  timed.variant = "walr";
  timed.timing.frames = 5;
  timed.timing.milliseconds = Spread{0.5, 0.4, 0.6};
  timed.timing.passes = {{"filter", {0.5, 0.4, 0.6}}};
  timed.models = {{.bytes = 1e6, .peak = Bounds{.bytes = 250.0}, .attainable = Bounds{.bytes = 400.0}}};
  MethodTimes disturbed = timed;
  disturbed.variant = "svgf";
  disturbed.timing.milliseconds = Spread{0.5, 0.4, 1.2};
  MethodTimes left;
  left.variant = "flr";
  left.whyNot = "needs 9 MiB";
  report.times = {{"scene", "beads", {1920, 1080}, {timed, disturbed, left}}, {"scene", "", {3840, 2160}, {left}}};
  return report;
}

TEST(GpuReportPage, ShowsTimesOverEstimatesAndWhatDidNotRun) {
  const std::string page = gpuReportPage(smallReport(), "walr gpu-report");
  fg::test::expectContains(
      page,
      {"# Abacus 9000", "no timestamps", "Clocks are not known: it has none", "no layer", "no estimates: it has beads",
       "truth only: no processor", "| `walr` | 0.5000 (0.4000 to 0.6000) | 5 | 250.0 | 2.00 | 2.0 |",
       "| `svgf` | 0.5000 (0.4000 to 1.2000) **unsteady** | 5 |", "| `flr` | needs 9 MiB |",
       "## Passes at 1920 x 1080, scene",
       "| filter | 0.5000 (0.4000 to 0.6000) | 1.0 | 250.0 | bytes | 2.00 | 400.0 | 1.25 |"});
}

}  // namespace
}  // namespace walr
