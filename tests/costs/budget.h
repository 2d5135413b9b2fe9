#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/costs/method_costs.h"

namespace walr::costs {

/// Most that a pass may cost: read from budget.json.
struct PassBudget {
  std::string method;  ///< With its preset, as `MethodName::text` writes it.
  std::string pass;
  std::uint64_t vectorRegisters = 0;
  std::uint64_t sharedBytes = 0;
  std::uint64_t instructions = 0;
  std::uint64_t branches = 0;
  /// Where other versions of the compiler need more than a tenth above `branches`. Written by hand, and kept by
  /// `budgetOf`.
  std::optional<std::uint64_t> branchesElsewhere;
  double cyclesPerWave = 0.0;  ///< Where there are no trip counts, the driver's inverse throughput.
  bool tripCounts = false;     ///< Whether these weigh the cycles.
};

/// The committed costs of all passes, by one compiler for one family of GPUs.
struct Budget {
  std::string driver;  ///< As `NullDevice::driver` writes it.
  std::string family;
  fg::Extent extent;
  std::vector<PassBudget> passes;
};

/// @throws std::runtime_error naming the file and what is wrong with it
Budget readBudget(const std::filesystem::path& file);
/// @throws std::runtime_error naming the file
void writeBudget(const Budget& budget, const std::filesystem::path& file);

/// What was measured, as a budget. What a person has written into the former one is kept.
Budget budgetOf(const std::vector<MethodCosts>& methods, const NullDevice& device, const Budget& former);

/// Hold costs against a budget.
///
/// With any version of the compiler, no pass spills registers or uses scratch memory, a SIMD holds three waves or more,
/// and there are at most a tenth more branches than in the budget. With the budget's own version, registers, LDS,
/// instructions and cycles lie at most 3 % above it, and loops have trip counts where they had them.
/// @param driver that compiled, for the family of the budget
/// @returns one line per violation, naming method, pass, figure and limit; also for passes that only one of the two has
std::vector<std::string> violations(const Budget& budget, const std::vector<MethodCosts>& methods,
                                    const std::string& driver);

}  // namespace walr::costs
