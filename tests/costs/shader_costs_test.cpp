#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "samples/bench/variant_estimate.h"
#include "tests/costs/figures.h"
#include "tests/costs/limits.h"
#include "tests/samples/temporary_directory.h"

namespace walr::costs {
namespace {

constexpr fg::Extent kExtent = {1920, 1080};

TEST(TripCounts, AreFoundByTheLongestNameAndTheNumberOfLoops) {
  const TripCounts trips(WALR_COSTS "/trip_counts.json");
  EXPECT_EQ(trips.of("block_atrous", 2).value().rounds, (std::vector<double>{8, 1}));
  EXPECT_EQ(trips.of("block_atrous.last", 2).value().rounds, (std::vector<double>{8, 3}));
  EXPECT_EQ(trips.of("atrous.raw16", 8).value().divergent, 0.067);
  EXPECT_FALSE(trips.of("block_atrous.last", 1).has_value());
  EXPECT_FALSE(trips.of("atrous_of_another_kind", 8).has_value());
  EXPECT_TRUE(trips.of("a shader without loops", 0).value().rounds.empty());
}

TEST(Machine, TakesTheLargestBoundAsItsEstimate) {
  const Machine machine = machineNamed("w6800");
  const WaveCounts wave = {
      .vector = 1000.0, .multiplications = 100.0, .transcendentals = 50.0, .fetches = 20.0, .waits = 10.0};
  // 60 processors of two SIMDs at 2.3 GHz: 276e9 cycles a second, and 552e9 texels.
  const Bounds bounds = boundsOn(machine, wave, 64.0 * 276e3, 10.0, 512e3);
  EXPECT_NEAR(bounds.bytes, 1.0, 1e-6);
  EXPECT_NEAR(bounds.instructions, 2600.0, 1e-6);
  EXPECT_NEAR(bounds.fetches, 640.0, 1e-6);
  EXPECT_NEAR(bounds.latency, 230.0 * (1.39 + 2000.0 / 2300.0), 1e-6);
  EXPECT_EQ(bounds.largest(), bounds.instructions);
  EXPECT_EQ(simdCycles(wave), 2600.0);
}

TEST(Machine, UnknownOnesAreNamedBesideTheKnown) {
  try {
    machineNamed("abacus");
    FAIL() << "the machine is taken";
  } catch (const std::invalid_argument& error) {
    for (const char* name : {"'abacus'", "w6800", "h200"}) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST(Machine, IsFoundByTheNameOfAVulkanDevice) {
  ASSERT_NE(machineOfDevice("AMD Radeon PRO W6800 (RADV NAVI21)"), nullptr);
  EXPECT_EQ(machineOfDevice("AMD Radeon PRO W6800 (RADV NAVI21)")->name, "w6800");
  EXPECT_EQ(machineOfDevice("NVIDIA H200")->name, "h200");
  EXPECT_EQ(machineOfDevice("llvmpipe (LLVM 15.0.6, 256 bits)"), nullptr);
}

/// A method with one pass, which takes as much as a SIMD can bear.
MethodCosts barelyGood() {
  PassCosts pass;
  pass.pass = "filter";
  pass.shader = "box_filter";
  pass.compiled.waves = 3;
  pass.wave.emplace();
  return {.name = {"method", "preset"}, .extent = {64, 64}, .passes = {pass}};
}

TEST(Limits, AreNoSpillsNoScratchMemoryAndThreeWaves) {
  MethodCosts method = barelyGood();
  EXPECT_TRUE(violations({method}).empty());
  method.passes[0].compiled.spills = 2;
  method.passes[0].compiled.scratchBytes = 1024;
  method.passes[0].compiled.waves = 2;
  EXPECT_EQ(violations({method}),
            (std::vector<std::string>{"method:preset, filter: 2 spilled registers, and not 0",
                                      "method:preset, filter: 1024 bytes of scratch memory, and not 0",
                                      "method:preset, filter: 2 waves a SIMD, and not 3 at least"}));
}

TEST(Limits, NameLoopsWithoutTripCounts) {
  MethodCosts method = barelyGood();
  EXPECT_TRUE(unknownLoops({method}).empty());
  method.passes[0].wave.reset();
  method.passes[0].loops = 3;
  EXPECT_EQ(unknownLoops({method}),
            std::vector<std::string>{
                "method:preset, filter: box_filter has 3 loops; write the rounds of each into trip_counts.json"});
}

/// The default method's costs, measured once.
class ShaderCostsOfTheDefault : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!selectRadv()) GTEST_SKIP() << "Mesa's driver for AMD GPUs is not installed";
    try {
      device_.emplace();
    } catch (const NoNullDevice& lacking) {
      GTEST_SKIP() << lacking.what();
    }
    costs_ = methodCosts({"walr", ""}, kExtent, *device_, trips_);
  }

  /// Why trip counts need not hold, if another compiler than that of the table may unroll other loops.
  [[nodiscard]] std::string otherCompiler() const {
    const std::string& known = shaderFigures().driver;
    if (device_->driver() == known) return {};
    return "compiled by " + device_->driver() + "; the trip counts are those of " + known;
  }

  std::optional<NullDevice> device_;
  TripCounts trips_{WALR_COSTS "/trip_counts.json"};
  MethodCosts costs_;
};

TEST_F(ShaderCostsOfTheDefault, CoverThePlan) {
  for (const PassCosts& pass : costs_.passes) {
    EXPECT_GT(pass.bytes, 0U) << pass.pass;
    EXPECT_GT(pass.threads, 0U) << pass.pass;
    EXPECT_GT(pass.compiled.instructions, 0U) << pass.pass;
    EXPECT_GT(pass.compiled.vectorRegisters, 0U) << pass.pass;
  }
  if (const std::string other = otherCompiler(); !other.empty()) GTEST_SKIP() << other;
  EXPECT_TRUE(costs_.cyclesPerPixel().has_value()) << "some loop has no trip count";
}

TEST_F(ShaderCostsOfTheDefault, GiveTheEstimatesThatProgramsComputeFromTheFigures) {
  if (const std::string other = otherCompiler(); !other.empty()) GTEST_SKIP() << other;
  const FigureTable table = figuresOf({costs_}, *device_, trips_, machineNamed("w6800"));
  const test::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "figures.json";
  std::ofstream(file) << figuresJson(table);
  const FigureTable read = readFigures(file);
  EXPECT_TRUE(differences(read, table).empty()) << ::testing::PrintToString(differences(read, table));

  const Variant walr = parseMethods("walr").at(0);
  for (const char* machine : {"w6800", "h200"}) {
    const auto estimated = estimatedMicroseconds(walr, kExtent, read, machineNamed(machine));
    ASSERT_TRUE(estimated.has_value());
    EXPECT_NEAR(*estimated, costs_.microseconds(machineNamed(machine)).value(), 1e-6);
  }
  // At this size, the method has more passes.
  EXPECT_GT(estimatedMicroseconds(walr, {3840, 2160}, read, machineNamed("w6800")).value(),
            3.0 * costs_.microseconds(machineNamed("w6800")).value());
  EXPECT_FALSE(
      estimatedMicroseconds(parseVariant("mine=walr,blocks.size=4"), kExtent, read, machineNamed("w6800")).has_value())
      << "settings that the figures do not hold for";
}

TEST_F(ShaderCostsOfTheDefault, NameWhatAStaleTableOfFiguresLacks) {
  const FigureTable now = figuresOf({costs_}, *device_, trips_, machineNamed("w6800"));
  FigureTable stale = now;
  stale.shaders.at(0).wave->vector += 1.0;
  stale.shaders.at(1).shader = "retired";
  stale.estimates.at(0).microseconds = 1.0;
  const auto found = differences(stale, now);
  ASSERT_EQ(found.size(), 4U) << ::testing::PrintToString(found);
  EXPECT_NE(found[0].find("'" + now.shaders[0].shader + "'"), std::string::npos) << found[0];
  EXPECT_NE(found[1].find("'" + now.shaders[1].shader + "'"), std::string::npos) << found[1];
  EXPECT_NE(found[2].find("'retired'"), std::string::npos) << found[2];
  EXPECT_NE(found[3].find("the estimate of walr"), std::string::npos) << found[3];
}

TEST_F(ShaderCostsOfTheDefault, AreTheSameEveryTime) {
  const auto again = methodCosts({"walr", ""}, kExtent, *device_, trips_);
  ASSERT_EQ(again.passes.size(), costs_.passes.size());
  for (std::size_t i = 0; i < again.passes.size(); ++i) {
    EXPECT_EQ(again.passes[i].compiled.instructions, costs_.passes[i].compiled.instructions);
    EXPECT_EQ(again.passes[i].cyclesPerWave(), costs_.passes[i].cyclesPerWave());
  }
}

}  // namespace
}  // namespace walr::costs
