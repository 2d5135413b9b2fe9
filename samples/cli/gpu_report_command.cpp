#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "samples/bench/plan_costs.h"
#include "samples/bench/variant.h"
#include "samples/cli/command.h"
#include "samples/cli/command_line.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/packed_frame.h"
#include "samples/gpu_report/gpu_report.h"
#include "samples/gpu_report/gpu_report_json.h"
#include "samples/gpu_report/gpu_report_page.h"
#include "samples/gpu_report/timed_content.h"
#include "samples/image/file_output.h"

namespace walr {
namespace {

constexpr fg::Extent kQuickExtent{96, 54};
/// It takes seconds a frame at the larger sizes.
constexpr std::string_view kSlowMethod = "refwlr";

struct GpuReportArguments {
  GpuReportOptions report;
  std::string methods = "usual";
  std::vector<std::string> variants;
  std::vector<std::string> sizes;
  std::filesystem::path sequence;
};

std::vector<Variant> chosenVariants(const GpuReportArguments& arguments) {
  try {
    std::vector<Variant> variants = parseMethods(arguments.methods == "usual" ? "all" : arguments.methods);
    if (arguments.methods == "usual") {
      std::erase_if(variants, [](const Variant& variant) { return variant.method == kSlowMethod; });
    }
    for (const std::string& text : arguments.variants) variants.push_back(parseVariant(text));
    requireDistinctNames(variants);
    return variants;
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

std::vector<fg::Extent> chosenSizes(const GpuReportArguments& arguments) {
  std::vector<fg::Extent> sizes;
  for (const std::string& size : arguments.sizes) sizes.push_back(parseSize(size, "--sizes"));
  if (!sizes.empty()) return sizes;
  if (arguments.report.quick) return {kQuickExtent};
  return {kCommonExtents.begin(), kCommonExtents.end()};
}

void requireMachine(const std::string& name) {
  try {
    if (!name.empty()) machineNamed(name);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void refuseOwnFolders(const GpuReportArguments& arguments) {
  for (const std::filesystem::path& folder : {arguments.sequence, arguments.report.against}) {
    std::error_code ignored;
    if (!folder.empty() && std::filesystem::equivalent(folder, arguments.report.output, ignored)) {
      throw UsageError("--output is also a folder to read from; choose another one");
    }
  }
}

/// @throws std::runtime_error if the report holds an error that a script should notice
void refuseErrors(const GpuReport& report) {
  refuseMessages(report.validation.messages);
  for (const Agreement& agreement : report.agreements) {
    if (agreement.nonFinite > 0) throw std::runtime_error(agreement.variant + " gives values that are not finite");
  }
}

void runGpuReport(GpuReportArguments& arguments, const std::string& command) {
  GpuReportOptions& options = arguments.report;
  options.variants = chosenVariants(arguments);
  options.sizes = chosenSizes(arguments);
  requireMachine(options.machine);
  refuseOwnFolders(arguments);
  std::optional<Sequence> sequence;
  if (!arguments.sequence.empty()) {
    SequenceOptions replacing;
    replacing.nonFinite = NonFinitePolicy::Replace;
    sequence.emplace(arguments.sequence, replacing);
    requireTwoFrames(*sequence, arguments.sequence.string());
    checkCameras(*sequence);
    options.sequence = &*sequence;
    options.sequenceName = std::filesystem::weakly_canonical(arguments.sequence).filename().string();
  }
  const GpuReport report = gpuReport(options, [](const std::string& step) { std::cerr << step << std::endl; });
  const std::filesystem::path page = options.output / "gpu_report.md";
  writeFileAtomically(options.output / "gpu_report.json", gpuReportJson(report, command));
  writeFileAtomically(page, gpuReportPage(report, command));
  std::cout << "report: " << page.string() << std::endl;
  refuseErrors(report);
}

}  // namespace

void registerGpuReport(CLI::App& program) {
  const auto arguments = std::make_shared<GpuReportArguments>();
  GpuReportOptions& options = arguments->report;
  CLI::App* command = program.add_subcommand("gpu-report",
                                             "The first thing to run on a GPU: validate, time every method and pass, "
                                             "measure bandwidth, compare with estimates "
                                             "and with the processor's results; in minutes");
  command
      ->add_option("-o,--output", options.output, "Folder for gpu_report.md, gpu_report.json and the compared results")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("--methods", arguments->methods,
                   "METHOD or METHOD:PRESET, separated by commas; 'usual' for all but refwlr, which takes seconds a "
                   "frame; or 'all'")
      ->type_name("LIST|usual|all")
      ->capture_default_str();
  command
      ->add_option(
          "--variant", arguments->variants,
          "Also a method with these settings under this name; repeatable. With changed settings it has no estimates")
      ->allow_extra_args(false)
      ->type_name("NAME=METHOD[:PRESET][,SETTING=VALUE]...");
  command
      ->add_option(
          "--sizes", arguments->sizes,
          "Sizes to time at, separated by commas; default: 1280x720,1920x1080,2560x1440,3840x2160. A size that "
          "does not fit into memory is reported and left out")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("WIDTHxHEIGHT,...");
  command
      ->add_option("--sequence", arguments->sequence,
                   "Also time and compare frames of this sequence (samples/docs/sequences.md), at its own size")
      ->type_name("DIR");
  command
      ->add_option(
          "--against", options.against,
          "Compare with the results of an earlier report, for instance of another machine; default: with those "
          "of a processor's Vulkan driver, if there is one")
      ->check(CLI::ExistingDirectory)
      ->type_name("DIR");
  command->add_option("--machine", options.machine, "GPU that times are estimated for; default: by the device's name")
      ->type_name("NAME");
  constexpr double kShortest = 0.0;
  constexpr double kLongest = 1000.0;
  command->add_option("--minutes", options.minutes, "Begin no further measurement after this time")
      ->check(numberFrom(kShortest, kLongest))
      ->capture_default_str();
  command->add_flag("--quick", options.quick,
                    "A few frames of small pictures: shows that everything runs, but its times mean nothing");
  addDeviceChoice(*command, options.gpu);
  command->footer(kExitCodeHelp);
  command->callback([arguments, command, &program] { runGpuReport(*arguments, commandLine(program, *command)); });
}

}  // namespace walr
