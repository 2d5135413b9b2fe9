#include "tests/costs/budget.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "samples/estimate/json_file.h"

namespace walr::costs {
namespace {

constexpr std::uint64_t kLeastWaves = 3;
constexpr double kMoreBranches = 1.1;
constexpr double kMoreOfAnythingElse = 1.03;

double cyclesPerWave(const PassCosts& pass) {
  return pass.cyclesPerWave().value_or(static_cast<double>(pass.compiled.inverseThroughput));
}

const PassBudget* find(const Budget& budget, const std::string& method, const std::string& pass) {
  const auto found = std::ranges::find_if(
      budget.passes, [&](const PassBudget& entry) { return entry.method == method && entry.pass == pass; });
  return found == budget.passes.end() ? nullptr : &*found;
}

std::string number(double value) {
  std::string text = std::to_string(value);
  text.resize(value == std::floor(value) ? text.find('.') : text.find('.') + 2);
  return text;
}

/// Holds the costs of one pass against its entry.
class PassCheck {
 public:
  PassCheck(std::string where, std::vector<std::string>& violations)
      : where_(std::move(where)), violations_(violations) {}

  void fail(const std::string& what) { violations_.push_back(where_ + ": " + what); }
  void atMost(const char* figure, double value, double limit) {
    if (value > limit) fail(number(value) + " " + figure + ", and not " + number(limit) + " at most");
  }

  void withAnyCompiler(const PassBudget& budget, const PassCosts& pass, bool sameCompiler) {
    atMost("spilled registers", static_cast<double>(pass.compiled.spills), 0.0);
    atMost("bytes of scratch memory", static_cast<double>(pass.compiled.scratchBytes), 0.0);
    if (pass.compiled.waves < kLeastWaves) {
      fail(std::to_string(pass.compiled.waves) + " waves a SIMD, and not " + std::to_string(kLeastWaves) + " at least");
    }
    double branches = std::ceil(kMoreBranches * static_cast<double>(budget.branches));
    if (!sameCompiler) branches = std::max(branches, static_cast<double>(budget.branchesElsewhere.value_or(0)));
    atMost("branches", static_cast<double>(pass.branches), branches);
  }

  void withSameCompiler(const PassBudget& budget, const PassCosts& pass) {
    const auto within = [this](const char* figure, double value, double limit) {
      atMost(figure, value, kMoreOfAnythingElse * limit);
    };
    within("vector registers", static_cast<double>(pass.compiled.vectorRegisters),
           static_cast<double>(budget.vectorRegisters));
    within("bytes of LDS", static_cast<double>(pass.compiled.sharedBytes), static_cast<double>(budget.sharedBytes));
    within("instructions", static_cast<double>(pass.compiled.instructions), static_cast<double>(budget.instructions));
    if (budget.tripCounts != pass.wave.has_value()) {
      fail("its " + std::to_string(pass.loops) + " loops have " + (pass.wave ? "trip counts now" : "no trip counts") +
           "; write the rounds of each into trip_counts.json, and the budget again");
      return;
    }
    within("cycles a wave", cyclesPerWave(pass), budget.cyclesPerWave);
  }

 private:
  std::string where_;
  std::vector<std::string>& violations_;
};

/// An entry of the file without its methods.
nlohmann::ordered_json toJson(const PassBudget& pass) {
  nlohmann::ordered_json json = {{"pass", pass.pass},
                                 {"vgprs", pass.vectorRegisters},
                                 {"lds", pass.sharedBytes},
                                 {"instructions", pass.instructions},
                                 {"branches", pass.branches}};
  if (pass.branchesElsewhere) json["branches_elsewhere"] = *pass.branchesElsewhere;
  json["cycles_per_wave"] = std::round(10.0 * pass.cyclesPerWave) / 10.0;
  json["trip_counts"] = pass.tripCounts;
  return json;
}

}  // namespace

Budget readBudget(const std::filesystem::path& file) {
  Budget budget;
  readJson(file, [&](const nlohmann::json& json) {
    budget.driver = json.at("driver");
    budget.family = json.at("family");
    budget.extent = {json.at("width"), json.at("height")};
    for (const nlohmann::json& entry : json.at("passes")) {
      PassBudget pass = {.method = {},
                         .pass = entry.at("pass"),
                         .vectorRegisters = entry.at("vgprs"),
                         .sharedBytes = entry.at("lds"),
                         .instructions = entry.at("instructions"),
                         .branches = entry.at("branches"),
                         .branchesElsewhere = {},
                         .cyclesPerWave = entry.at("cycles_per_wave"),
                         .tripCounts = entry.at("trip_counts")};
      if (entry.contains("branches_elsewhere")) pass.branchesElsewhere = entry.at("branches_elsewhere");
      for (const nlohmann::json& method : entry.at("methods")) {
        pass.method = method;
        budget.passes.push_back(pass);
      }
    }
  });
  return budget;
}

void writeBudget(const Budget& budget, const std::filesystem::path& file) {
  // Methods whose passes cost the same share an entry.
  std::vector<std::pair<nlohmann::ordered_json, std::vector<std::string>>> entries;
  for (const PassBudget& pass : budget.passes) {
    nlohmann::ordered_json json = toJson(pass);
    auto entry = std::ranges::find(entries, json, &decltype(entries)::value_type::first);
    if (entry == entries.end()) entry = entries.emplace(entry, std::move(json), std::vector<std::string>());
    entry->second.push_back(pass.method);
  }
  // A line per entry, so that a change of one shows as such.
  std::ofstream stream(file);
  stream << "{\n  \"driver\": " << nlohmann::json(budget.driver) << ",\n  \"family\": " << nlohmann::json(budget.family)
         << ",\n  \"width\": " << budget.extent.width << ",\n  \"height\": " << budget.extent.height
         << ",\n  \"passes\": [";
  const char* separator = "\n    ";
  for (auto& [json, methods] : entries) {
    json["methods"] = methods;
    stream << std::exchange(separator, ",\n    ") << json;
  }
  stream << "\n  ]\n}\n";
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

Budget budgetOf(const std::vector<MethodCosts>& methods, const NullDevice& device, const Budget& former) {
  Budget budget = {device.driver(), device.family(), methods.at(0).extent, {}};
  for (const MethodCosts& method : methods) {
    for (const PassCosts& pass : method.passes) {
      const PassBudget* before = find(former, method.name.text(), pass.pass);
      budget.passes.push_back({.method = method.name.text(),
                               .pass = pass.pass,
                               .vectorRegisters = pass.compiled.vectorRegisters,
                               .sharedBytes = pass.compiled.sharedBytes,
                               .instructions = pass.compiled.instructions,
                               .branches = pass.branches,
                               .branchesElsewhere = before != nullptr ? before->branchesElsewhere : std::nullopt,
                               .cyclesPerWave = cyclesPerWave(pass),
                               .tripCounts = pass.wave.has_value()});
    }
  }
  return budget;
}

std::vector<std::string> violations(const Budget& budget, const std::vector<MethodCosts>& methods,
                                    const std::string& driver) {
  std::vector<std::string> found;
  const bool sameCompiler = driver == budget.driver;
  for (const MethodCosts& method : methods) {
    const std::string name = method.name.text();
    for (const PassCosts& pass : method.passes) {
      PassCheck check(name + ", " + pass.pass, found);
      const PassBudget* entry = find(budget, name, pass.pass);
      if (entry == nullptr) {
        check.fail("the budget does not have this pass; write the budget again");
        continue;
      }
      check.withAnyCompiler(*entry, pass, sameCompiler);
      if (sameCompiler) check.withSameCompiler(*entry, pass);
    }
    for (const PassBudget& entry : budget.passes) {
      if (entry.method == name &&
          std::ranges::find(method.passes, entry.pass, &PassCosts::pass) == method.passes.end()) {
        PassCheck(name + ", " + entry.pass, found).fail("the plan no longer has this pass; write the budget again");
      }
    }
  }
  return found;
}

}  // namespace walr::costs
