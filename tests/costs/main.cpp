#include <algorithm>
#include <iostream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "samples/command_line/arguments.h"
#include "samples/command_line/program.h"
#include "samples/image/file_output.h"
#include "tests/costs/figures.h"
#include "tests/costs/limits.h"
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
  }
  for (const std::string& line : unknownLoops(methods)) std::cout << '\n' << line << '\n';
}

/// @returns the exit code
int check(const Options& options, NullDevice& device) {
  const FigureTable committed = readFigures(options.check);
  if (device.family() != committed.family) {
    throw std::runtime_error(options.check + " is for " + committed.family + ", not " + device.family() +
                             ": unset RADV_FORCE_FAMILY");
  }
  const auto methods = costsOf({}, committed.extent, device);
  auto found = violations(methods);
  if (committed.driver == device.driver()) {
    std::ranges::move(unknownLoops(methods), std::back_inserter(found));
    for (const std::string& line :
         differences(committed, figuresOf(methods, device, tripCounts(), machineNamed(committed.machine)))) {
      found.push_back(line + "; build the target update_costs");
    }
  } else {
    std::cout << "Compiled by " << device.driver() << " and not by " << committed.driver
              << ", so that only spills, scratch memory and waves are looked at.\n";
  }
  for (const std::string& violation : found) std::cout << violation << '\n';
  return found.empty() ? 0 : 1;
}

int run(const Options& options) {
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
  const std::string json = figuresJson(figuresOf(methods, device, tripCounts(), machineNamed(kDefaultMachine)));
  writeFileAtomically(options.update, std::as_bytes(std::span(json)));
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
  CLI::Option_group* task = program.add_option_group("Table", "In place of printing");
  task->add_option(
          "--check", options.check,
          "Hold the costs of all methods against a table of figures and the limits: exit code 1 if they differ")
      ->type_name("FILE")
      ->check(CLI::ExistingFile)
      ->excludes(methods, size);
  task->add_option("--update", options.update, "Write the figures of all methods as the table")
      ->type_name("FILE")
      ->excludes(methods, size);
  task->require_option(0, 1);
  program.callback([&] { result = walr::costs::run(options); });
  const int error = walr::runProgram(program, argc, argv);
  return error != 0 ? error : result;
}
