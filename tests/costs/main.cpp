#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "samples/command_line/arguments.h"
#include "samples/command_line/program.h"
#include "samples/command_line/usage_error.h"
#include "samples/image/file_output.h"
#include "tests/costs/budget.h"
#include "tests/costs/figures.h"
#include "tests/costs/table.h"

namespace walr::costs {
namespace {

constexpr int kSkipped = 77;

struct Options {
  std::vector<std::string> methods;
  std::string size = "1920x1080";
  std::string machine = std::string(kDefaultMachine);
  std::string check;
  std::string update;
  std::string figures;
};

TripCounts tripCounts() {
  return TripCounts(WALR_COSTS "/trip_counts.json");
}

std::vector<MethodCosts> costsOf(const std::vector<std::string>& names, fg::Extent extent, NullDevice& device) {
  const TripCounts trips = tripCounts();
  std::vector<MethodCosts> costs;
  const auto add = [&](const std::vector<MethodName>& methods) {
    for (const MethodName& method : methods) costs.push_back(methodCosts(method, extent, device, trips));
  };
  if (names.empty()) add(allMethods());
  for (const std::string& name : names) add(methodsNamed(name));
  return costs;
}

void print(const std::vector<MethodCosts>& methods, const std::string& machineName, const NullDevice& device) {
  const Machine& machine = machineNamed(machineName);
  std::cout << "Compiled by " << device.driver() << " for " << device.family()
            << "; nothing was run. ESTIMATE is no measured time: the largest of four bounds on " << machine.name << " ("
            << machine.gpu << ").\n";
  for (const MethodCosts& method : methods) {
    std::cout << "\n### " << method.name.text() << ", " << method.extent.width << " x " << method.extent.height
              << "\n\n"
              << costTable(method, machine);
    for (const PassCosts& pass : method.passes) {
      if (pass.wave) continue;
      std::cout << "\n"
                << pass.shader << " has " << pass.loops << " loops, for which trip_counts.json has no rounds.\n";
    }
  }
}

/// @returns the exit code
int check(const Options& options, NullDevice& device) {
  const Budget budget = readBudget(options.check);
  if (device.family() != budget.family) {
    throw std::runtime_error(options.check + " is a budget for " + budget.family + ", not " + device.family() +
                             ": unset RADV_FORCE_FAMILY");
  }
  const auto methods = costsOf(options.methods, budget.extent, device);
  auto found = violations(budget, methods, device.driver());
  if (!options.figures.empty()) {
    const FigureTable committed = readFigures(options.figures);
    if (committed.driver == device.driver()) {
      for (const std::string& line :
           differences(committed, figuresOf(methods, device, tripCounts(), machineNamed(committed.machine)))) {
        found.push_back(line + "; build the target update_costs");
      }
    }
  }
  for (const std::string& violation : found) std::cout << violation << '\n';
  std::cout << (found.empty() ? "Within the budget" : "Not within the budget") << " of " << budget.driver << " for "
            << budget.family;
  if (device.driver() != budget.driver) {
    std::cout << "; compiled by " << device.driver()
              << ", so that only spills, scratch memory, waves and branches were looked at";
  }
  std::cout << ".\n";
  return found.empty() ? 0 : 1;
}

int run(const Options& options) {
  if (!options.figures.empty() && options.check.empty() && options.update.empty()) {
    throw UsageError("--figures needs --check or --update");
  }
  if (!selectRadv()) {
    std::cout << "Skipped: Mesa's driver for AMD GPUs is not installed (package mesa-vulkan-drivers).\n";
    return kSkipped;
  }
  NullDevice device;
  if (!options.check.empty()) return check(options, device);
  const auto methods = costsOf(options.methods, parseSize(options.size), device);
  if (options.update.empty()) {
    print(methods, options.machine, device);
    return 0;
  }
  const Budget former = std::filesystem::exists(options.update) ? readBudget(options.update) : Budget();
  writeBudget(budgetOf(methods, device, former), options.update);
  if (!options.figures.empty()) {
    const std::string json = figuresJson(figuresOf(methods, device, tripCounts(), machineNamed(kDefaultMachine)));
    writeFileAtomically(options.figures, std::as_bytes(std::span(json)));
  }
  return 0;
}

}  // namespace
}  // namespace walr::costs

int main(int argc, char** argv) {
  CLI::App program("Costs of all shaders on an AMD GPU, by Mesa's compiler: needs no GPU and runs nothing",
                   "shader_costs");
  walr::costs::Options options;
  int result = 0;
  CLI::Option* methods =
      program.add_option("methods", options.methods, "METHOD, for all its presets, or METHOD:PRESET; all without any");
  CLI::Option* size = program.add_option("--size", options.size, "Size of the picture in pixels");
  size->type_name("WIDTHxHEIGHT")->capture_default_str();
  program.add_option("--machine", options.machine, "GPU of machines.json that times are estimated for")
      ->capture_default_str();
  CLI::Option_group* task = program.add_option_group("Budget", "In place of the tables");
  task->add_option("--check", options.check, "Hold the costs against a budget: exit code 1 if one is higher")
      ->type_name("FILE")
      ->check(CLI::ExistingFile)
      ->excludes(size);
  task->add_option("--update", options.update, "Write the costs of all methods as the budget")
      ->type_name("FILE")
      ->excludes(methods);
  task->require_option(0, 1);
  program
      .add_option("--figures", options.figures,
                  "Also hold samples/estimate/shader_figures.json against the shaders, or write it")
      ->type_name("FILE")
      ->excludes(methods);
  program.callback([&] { result = walr::costs::run(options); });
  const int error = walr::runProgram(program, argc, argv);
  return error != 0 ? error : result;
}
