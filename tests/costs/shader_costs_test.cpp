#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/costs/budget.h"
#include "tests/costs/machine.h"

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
  const Machine machine = readMachine(WALR_COSTS "/machines.json", "w6800");
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
    readMachine(WALR_COSTS "/machines.json", "abacus");
    FAIL() << "the machine is taken";
  } catch (const std::runtime_error& error) {
    for (const char* name : {"'abacus'", "w6800", "h200"}) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

/// The default method's costs, measured once.
class ShaderCostsOfTheDefault : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!selectRadv()) GTEST_SKIP() << "Mesa's driver for AMD GPUs is not installed";
    device_.emplace();
    costs_ = methodCosts({"walr", ""}, kExtent, *device_, TripCounts(WALR_COSTS "/trip_counts.json"));
    budget_ = budgetOf({costs_}, *device_, Budget());
  }

  [[nodiscard]] std::vector<std::string> found(const Budget& budget) const {
    return violations(budget, {costs_}, device_->driver());
  }

  std::optional<NullDevice> device_;
  MethodCosts costs_;
  Budget budget_;
};

TEST_F(ShaderCostsOfTheDefault, FailTheCheckOnceTheBudgetFileIsLowered) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "lowered_budget.json";
  writeBudget(budget_, file);
  EXPECT_TRUE(found(readBudget(file)).empty());

  Budget lowered = readBudget(file);
  lowered.passes.at(0).vectorRegisters /= 2;
  lowered.passes.at(1).cyclesPerWave *= 0.9;
  lowered.passes.at(2).branches = 0;
  writeBudget(lowered, file);
  const auto violations = found(readBudget(file));
  ASSERT_EQ(violations.size(), 3U) << ::testing::PrintToString(violations);
  EXPECT_NE(violations[0].find("vector registers"), std::string::npos) << violations[0];
  EXPECT_NE(violations[1].find("cycles a wave"), std::string::npos) << violations[1];
  EXPECT_NE(violations[2].find("branches, and not 0 at most"), std::string::npos) << violations[2];
  std::filesystem::remove(file);
}

TEST_F(ShaderCostsOfTheDefault, CoverThePlan) {
  EXPECT_TRUE(costs_.cyclesPerPixel().has_value()) << "some loop has no trip count";
  for (const PassCosts& pass : costs_.passes) {
    EXPECT_GT(pass.bytes, 0U) << pass.pass;
    EXPECT_GT(pass.threads, 0U) << pass.pass;
    EXPECT_GT(pass.compiled.instructions, 0U) << pass.pass;
    EXPECT_GT(pass.compiled.vectorRegisters, 0U) << pass.pass;
    EXPECT_TRUE(pass.taps.has_value()) << pass.pass;
  }
}

TEST_F(ShaderCostsOfTheDefault, AreTheSameEveryTime) {
  const auto again = methodCosts({"walr", ""}, kExtent, *device_, TripCounts(WALR_COSTS "/trip_counts.json"));
  ASSERT_EQ(again.passes.size(), costs_.passes.size());
  for (std::size_t i = 0; i < again.passes.size(); ++i) {
    EXPECT_EQ(again.passes[i].compiled.instructions, costs_.passes[i].compiled.instructions);
    EXPECT_EQ(again.passes[i].cyclesPerWave(), costs_.passes[i].cyclesPerWave());
  }
}

}  // namespace
}  // namespace walr::costs
