#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "integration/denoise_graph.h"
#include "samples/bench/bench.h"
#include "samples/bench/bench_report.h"
#include "samples/bench/html_report.h"
#include "samples/bench/variant.h"
#include "samples/cli/command.h"
#include "samples/cli/command_line.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/device_options.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/light_rate.h"
#include "samples/command_line/motion_depth.h"
#include "samples/command_line/usage_error.h"
#include "samples/image/file_output.h"

namespace walr {
namespace {

struct BenchArguments {
  std::vector<std::filesystem::path> sequences;
  std::string methods = "all";
  std::vector<std::string> variants;
  std::string frames;
  SequenceOptions sequence;
  GpuDevice::Options gpu;
  std::string light = "indirect";
  BenchOptions bench;
  bool noHtml = false;
  std::string python = "/usr/bin/python3";
};

/// @throws UsageError naming an option that specular light does not have
void refuseWithSpecularLight(const BenchArguments& arguments) {
  const auto refuse = [](const std::string& option) {
    throw UsageError("--light specular cannot have " + option + ", which is of diffuse light: leave out one of them");
  };
  if (arguments.bench.response) refuse("--response");
  if (arguments.bench.hardCases) refuse("--hard-cases");
  if (!arguments.sequence.keptLight.everyPixel()) refuse("--light-rate");
}

/// Variants in the order of the command line, the baseline first.
std::vector<Variant> chosenVariants(const BenchArguments& arguments) {
  try {
    std::vector<Variant> variants = parseMethods(arguments.methods);
    if (arguments.methods == "all" && arguments.sequence.light.onlySpecular()) {
      std::erase_if(variants, [](const Variant& variant) { return !makeVariant(variant)->takesSpecularLight(); });
    }
    const LightKinds lights = arguments.sequence.light.onlySpecular() ? kSpecularLight : kDiffuseLight;
    for (const std::string& text : arguments.variants) variants.push_back(parseVariant(text, lights));
    return withBaseline(std::move(variants));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

void refuseOutputIntoInput(const BenchArguments& arguments) {
  for (const std::filesystem::path& sequence : arguments.sequences) {
    std::error_code ignored;
    if (std::filesystem::equivalent(sequence, arguments.bench.output, ignored)) {
      throw UsageError("--output is the folder of a sequence; choose another folder");
    }
  }
}

/// @throws UsageError if a variant cannot denoise the frames of a sequence
void requireUsable(const std::vector<Variant>& variants, const std::vector<NamedSequence>& sequences) {
  for (const NamedSequence& named : sequences) {
    const InputConventions& conventions = named.sequence.denoiserLayout().conventions;
    for (const Variant& variant : variants) {
      try {
        declareDenoiseGraph(*makeVariant(variant), named.sequence.extent(), conventions, kComputeHost);
      } catch (const std::invalid_argument& error) {
        throw UsageError(named.name + ": " + error.what() + "; choose methods for these frames with --methods");
      }
    }
  }
}

void runBench(BenchArguments& arguments, const std::string& command) {
  if (arguments.sequences.empty() && !arguments.bench.response && !arguments.bench.hardCases) {
    throw UsageError("nothing to measure: give --sequences DIR..., --response or --hard-cases");
  }
  if (arguments.light == "specular") {
    refuseWithSpecularLight(arguments);
    arguments.sequence.light = {.indirect = false, .specular = SpecularWish::Denoised};
  }
  arguments.bench.variants = chosenVariants(arguments);
  refuseOutputIntoInput(arguments);
  arguments.sequence.nonFinite = NonFinitePolicy::Replace;
  if (!arguments.frames.empty()) arguments.sequence.frames = parseFrameRange(arguments.frames);
  const std::vector<NamedSequence> sequences = openSequences(arguments.sequences, arguments.sequence);
  requireUsable(arguments.bench.variants, sequences);
  const std::filesystem::path& output = arguments.bench.output;
  prepareOutputDirectory(output);

  GpuDevice device(arguments.gpu);
  std::cout << "device: " << device.name() << ", driver " << device.driver()
            << (device.isSoftware() ? " (software)" : "") << std::endl;
  const BenchReport report = bench(device, sequences, arguments.bench, std::cerr, isatty(STDERR_FILENO) != 0);
  device.refuseMessages();
  printSummary(std::cout, report);
  writeFileAtomically(output / "bench.json", benchJson(report, command));
  if (arguments.noHtml) return;
  const std::string trouble = writeHtmlReport(output, arguments.python);
  std::cout << (trouble.empty() ? "report: " + (output / "report.html").string() : trouble) << std::endl;
}

}  // namespace

void registerBench(CLI::App& program) {
  const auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command = program.add_subcommand(
      "bench", "Measure speed against error: methods and settings on the same frames, in alternation");
  command
      ->add_option("--sequences", arguments->sequences,
                   "Folders of frames with references (samples/docs/sequences.md); optional with --response or "
                   "--hard-cases")
      ->type_name("DIR...");
  command
      ->add_option(
          "-o,--output", arguments->bench.output,
          "Folder for bench.json, report.html, bench.csv and their data. If it holds finished runs, only missing "
          "and changed ones are run")
      ->required()
      ->type_name("DIR");
  command
      ->add_option(
          "--light", arguments->light,
          "Light that is denoised and judged: diffuse indirect light, or specular light, whose errors are also "
          "told by roughness")
      ->check(CLI::IsMember({"indirect", "specular"}))
      ->option_text("indirect|specular=indirect");
  command
      ->add_option("--methods", arguments->methods,
                   "METHOD or METHOD:PRESET, separated by commas, or 'all' that take the light. walr is always "
                   "included, because times are "
                   "given as ratios to it")
      ->type_name("LIST|all")
      ->capture_default_str();
  command
      ->add_option("--variant", arguments->variants,
                   "Also run a method with these settings under this name; repeatable")
      ->allow_extra_args(false)
      ->type_name("NAME=METHOD[:PRESET][,SETTING=VALUE]...");
  command->add_option("--frames", arguments->frames, "First and last frame; default: all")->type_name("A-B");
  addMotionDepth(*command, arguments->sequence);
  addLightRate(*command, arguments->sequence.keptLight, kKeptLightHelp);
  command->add_flag("--hard-cases", arguments->bench.hardCases,
                    "Also run every method, and the regression of walr_paper with every storage of moments and every "
                    "solver, on frames that are numerically hard: error against the known truth, non-finite values");
  command->add_flag("--response", arguments->bench.response,
                    "Also measure how each variant responds to change, on synthetic scenes with known truth: first "
                    "frame, settled error and flicker, a light that dims or moves, disocclusion, a camera cut");
  command->add_flag(
      "--all-pictures", arguments->bench.allPictures,
      "Keep the images and error maps of every frame with a reference, for analysis elsewhere; default: of "
      "the last one and the one with the largest disocclusion");
  command
      ->add_option(
          "--repeat", arguments->bench.repetitions,
          "Number of timed passes over each sequence, after one that warms up and measures errors; 0: no times")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--batch", arguments->bench.batch,
                   "Number of variants that run in alternation; fewer need less device memory")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  addDeviceOptions(*command, arguments->gpu, "Times are then not meaningful");
  command->add_flag("--no-html", arguments->noHtml, "Do not draw report.html");
  command->add_option("--python", arguments->python, "Python 3 with matplotlib, which draws report.html")
      ->type_name("FILE")
      ->capture_default_str();
  command->footer(kExitCodeHelp);
  command->callback([arguments, command, &program] { runBench(*arguments, commandLine(program, *command)); });
}

}  // namespace walr
