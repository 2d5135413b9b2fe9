#include "tests/costs/budget.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace walr::costs {
namespace {

constexpr const char* kDriver = "Mesa 22.3.6";

/// Expects one violation for each text, which it contains, in this order.
void expectViolations(const std::vector<std::string>& found, const std::vector<std::string>& texts) {
  ASSERT_EQ(found.size(), texts.size()) << ::testing::PrintToString(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NE(found[i].find(texts[i]), std::string::npos) << found[i] << "\ndoes not contain\n" << texts[i];
  }
}

/// A method of one pass that costs what its budget says.
class BudgetCheck : public ::testing::Test {
 protected:
  BudgetCheck() {
    PassCosts pass;
    pass.pass = "filter";
    pass.compiled = {.vectorRegisters = 48,
                     .sharedBytes = 512,
                     .spills = 0,
                     .scratchBytes = 0,
                     .waves = 10,
                     .instructions = 1000,
                     .inverseThroughput = 900,
                     .assembly = {}};
    pass.branches = 20;
    pass.loops = 1;
    pass.wave =
        WaveCounts{.vector = 1000.0, .multiplications = 0.0, .transcendentals = 0.0, .fetches = 9.0, .waits = 3.0};
    method.name = {"method", "preset"};
    method.extent = {64, 64};
    method.passes = {pass};
    budget = {kDriver, "NAVI21", method.extent, {}};
    budget.passes.push_back({.method = "method:preset",
                             .pass = "filter",
                             .vectorRegisters = 48,
                             .sharedBytes = 512,
                             .instructions = 1000,
                             .branches = 20,
                             .branchesElsewhere = {},
                             .cyclesPerWave = 2000.0,
                             .tripCounts = true});
  }

  [[nodiscard]] std::vector<std::string> found(const char* driver = kDriver) const {
    return violations(budget, {method}, driver);
  }
  PassCosts& pass() { return method.passes[0]; }
  PassBudget& entry() { return budget.passes[0]; }

  MethodCosts method;
  Budget budget;
};

TEST_F(BudgetCheck, PassesWhatItWasMadeOf) {
  expectViolations(found(), {});
}

TEST_F(BudgetCheck, AllowsThreePercent) {
  entry().instructions = 971;
  expectViolations(found(), {});
  entry().instructions = 970;
  expectViolations(found(), {"method:preset, filter: 1000 instructions, and not 999.1 at most"});
}

TEST_F(BudgetCheck, FailsWhereAnyFigureIsAboveALoweredBudget) {
  entry().vectorRegisters = 40;
  entry().sharedBytes = 256;
  entry().instructions = 500;
  entry().branches = 10;
  entry().cyclesPerWave = 1000.0;
  expectViolations(found(), {"20 branches, and not 11 at most", "48 vector registers", "512 bytes of LDS",
                             "1000 instructions", "2000 cycles a wave"});
}

TEST_F(BudgetCheck, FailsOnSpillsScratchAndFewWavesWithAnyCompiler) {
  pass().compiled.spills = 2;
  pass().compiled.scratchBytes = 1024;
  pass().compiled.waves = 2;
  for (const char* driver : {kDriver, "Mesa 25.0.7"}) {
    expectViolations(found(driver), {"method:preset, filter: 2 spilled registers, and not 0 at most",
                                     "1024 bytes of scratch memory", "2 waves a SIMD"});
  }
}

TEST_F(BudgetCheck, LooksOnlyAtWhatAllCompilersShareWithAnotherOne) {
  entry().vectorRegisters = 8;
  entry().instructions = 1;
  entry().cyclesPerWave = 1.0;
  expectViolations(found("Mesa 25.0.7"), {});
  pass().branches = 23;
  expectViolations(found("Mesa 25.0.7"), {"23 branches, and not 22 at most"});
  entry().branchesElsewhere = 23;
  expectViolations(found("Mesa 25.0.7"), {});
}

TEST_F(BudgetCheck, AllowsMoreBranchesElsewhereOnlyToOtherCompilers) {
  pass().branches = 23;
  entry().branchesElsewhere = 23;
  expectViolations(found(), {"23 branches, and not 22 at most"});
  expectViolations(found("Mesa 25.0.7"), {});
}

TEST_F(BudgetCheck, FailsWhereLoopsHaveLostTheirTripCounts) {
  pass().wave.reset();
  expectViolations(found(), {"its 1 loops have no trip counts"});
}

TEST_F(BudgetCheck, ComparesTheDriversGuessWhereThereNeverWereTripCounts) {
  pass().wave.reset();
  entry().tripCounts = false;
  entry().cyclesPerWave = 900.0;
  expectViolations(found(), {});
  entry().cyclesPerWave = 800.0;
  expectViolations(found(), {"900 cycles a wave, and not 824 at most"});
}

TEST_F(BudgetCheck, NamesPassesThatOnlyOneOfBothHas) {
  pass().pass = "new filter";
  expectViolations(found(), {"method:preset, new filter: the budget does not have this pass; write the budget again",
                             "method:preset, filter: the plan no longer has this pass; write the budget again"});
}

}  // namespace
}  // namespace walr::costs
