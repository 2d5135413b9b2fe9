#include "samples/bench/numerics.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "samples/bench/hard_case_scenes.h"
#include "tests/samples/bench_schema.h"

namespace walr::bench_numerics_test {
namespace {

TEST(HardCases, NoiseHasTheTruthAsItsMean) {
  for (const HardCase& hardCase : hardCases()) {
    SCOPED_TRACE(hardCase.name);
    double difference = 0.0;
    double truthSquared = 0.0;
    bool finite = true;
    for (std::size_t i = 0; i < hardCase.counted.size(); ++i) {
      const double truth = hardCase.truth.pixel(i)[1];
      const double sample = hardCase.packed.frame.indirect.pixel(i)[1];
      finite = finite && std::isfinite(sample);
      difference += sample - truth;
      truthSquared += truth * truth;
    }
    // The standard deviation of a sample is its mean; the tolerance is five of them. Fireflies are outliers on purpose.
    if (finite && hardCase.name.find("firefly") == std::string::npos) {
      EXPECT_LE(std::abs(difference), 5.0 * std::sqrt(truthSquared));
    }
    EXPECT_NE(std::ranges::count(hardCase.counted, 1), 0);
  }
}

TEST(Numerics, TellStableFromUnstableArithmetic) {
  GpuDevice device({.device = {}, .validation = true});
  const std::vector<NumericsSetting> settings = {{"centred16", "ridge", "1e-3"}, {"raw11", "floor", "1e-6"}};
  const std::vector<NumericsResult> results = numerics(device, settings);
  ASSERT_EQ(results.size(), settings.size() * hardCases().size());
  const auto find = [&](const std::string& storage, const std::string& hardCase) {
    return *std::ranges::find_if(results, [&](const NumericsResult& result) {
      return result.setting.storage == storage && result.hardCase == hardCase;
    });
  };
  // A mean over all 27 x 27 samples would leave 1 / 27 of the noise. At the borders the window contains only a half or
  // a quarter of the samples.
  for (const char* name : {"flat wall", "normals vary by 0.001", "radiance of 10,000", "depth of 1,000,000"}) {
    EXPECT_GT(find("centred16", name).error, 1.0 / 27.0) << name;
    EXPECT_LT(find("centred16", name).error, 4.0 / 27.0) << name;
  }
  for (const NumericsResult& result : results) {
    if (result.setting.storage == "centred16") {
      EXPECT_EQ(result.nonFiniteOut, 0U) << result.hardCase;
    }
  }
  EXPECT_EQ(find("centred16", "infinite sample").nonFiniteIn, 3U);
  const auto counted = [&](const std::string& storage, const std::string& hardCase, const std::string& counter) {
    const NumericsResult result = find(storage, hardCase);
    const auto found = std::ranges::find(result.counters, counter, &CounterValue::name);
    EXPECT_NE(found, result.counters.end()) << counter;
    return found == result.counters.end() ? 0 : found->value;
  };
  EXPECT_EQ(counted("centred16", "infinite sample", "non-finite-lighting"), 1U) << "the pixel counts once";
  EXPECT_EQ(counted("centred16", "flat wall", "non-finite-lighting"), 0U);
  constexpr std::uint64_t kPixels = std::uint64_t{kHardCaseExtent.width} * kHardCaseExtent.height;
  EXPECT_EQ(counted("centred16", "flat wall", "regularised-fits"), kPixels) << "features that do not vary";
  EXPECT_EQ(counted("centred16", "normals vary by 0.3", "regularised-fits"), 0U);
  // With eleven bits, the error of E[xx] - E[x]^2 for such normals is a few times its value.
  EXPECT_GT(find("raw11", "normals vary by 0.1").error, 100.0);
  EXPECT_TRUE(device.takeMessages().empty());
  BenchReport report;
  report.numerics = results;
  EXPECT_EQ(test::schemaTroubles(report), "");
}

/// A denoiser may leave noise, but must not add errors or produce values that are no light.
// A pixel alone in the sky must be returned unchanged, except that `walr` stores packed light: the mean over time
// differs by less than one step of 7 bits (2^-6 of the brightest channel), and the filtered colour by one of 9 bits.
constexpr double kPackedRoundoff = 0x1p-6 + 0x1p-8;

TEST(MethodHardCases, NothingComesOutWorseThanItWentIn) {
  GpuDevice device({.device = {}, .validation = true});
  const std::vector<Variant> variants =
      parseMethods("none,walr,walr_paper:robust,bmfr,svgf,svgf:paper,flr,joint_bilateral");
  const std::vector<MethodHardCase> results = methodHardCases(device, variants);
  ASSERT_EQ(results.size(), variants.size() * hardCases().size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const MethodHardCase& result = results[i];
    const MethodHardCase& noisy = results[i % hardCases().size()];
    SCOPED_TRACE(result.variant + ", " + result.hardCase);
    RecordProperty(result.variant + ", " + result.hardCase, std::to_string(result.error));
    ASSERT_EQ(result.hardCase, noisy.hardCase);
    if (result.variant == "none") continue;
    EXPECT_EQ(result.nonFiniteOut, 0U);
    EXPECT_EQ(result.negativeOut, 0U);
    // Errors are relative to the truth, so the noisy light is at most 1 plus its own error.
    const double rounding = result.variant == "walr" ? kPackedRoundoff * (1.0 + noisy.error) : 0.0;
    EXPECT_LE(result.error, noisy.error + rounding);
  }
  EXPECT_TRUE(device.takeMessages().empty());
  BenchReport report;
  report.methodHardCases = results;
  EXPECT_EQ(test::schemaTroubles(report), "");
}

}  // namespace
}  // namespace walr::bench_numerics_test
