#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "framegraph/compile/compile.h"
#include "framegraph/inspect/inspect.h"
#include "integration/denoise_graph.h"
#include "integration/registry.h"
#include "samples/cli/command.h"
#include "samples/command_line/arguments.h"
#include "samples/command_line/exit_code.h"
#include "samples/command_line/light_rate.h"
#include "samples/command_line/method_options.h"
#include "samples/command_line/usage_error.h"
#include "samples/image/file_output.h"

namespace walr {
namespace {

struct GraphOptions {
  MethodOptions method;
  std::string lights = "diffuse";
  std::string secondPreset;  ///< Empty: there is one diffuse light.
  std::string size = "1920x1080";
  LightPattern light;
  bool json = false;
  bool dot = false;
  bool svg = false;
  std::vector<std::string> why;
  std::string output;
  bool listSettings = false;
  bool listPasses = false;
};

/// The answer to `--why`.
/// @throws UsageError naming a pass, texture or buffer that the method does not have
std::string explain(const std::vector<std::string>& names, const fg::GraphDesc& graph, const fg::Plan& plan) {
  const auto require = [](const auto& declared, const std::string& name, const char* kind) {
    const auto sameName = [&](const auto& decl) { return decl.name == name; };
    if (std::ranges::none_of(declared, sameName)) {
      throw UsageError("--why " + name + ": the method has no " + kind + " '" + name + "'; 'walr graph' lists them");
    }
  };
  if (names.size() == 1) {
    require(graph.passes, names[0], "pass");
    return fg::whyCulled(graph, plan, names[0]) + "\n" + fg::whyBarriers(graph, plan, names[0]);
  }
  for (const std::string& name : names) require(graph.resources, name, "texture or buffer");
  return fg::whyNotAliased(graph, plan, names[0], names[1]) + "\n";
}

/// The properties of scene and host that the plan is compiled for.
std::string sceneText(Denoiser& method) {
  constexpr std::string_view kPrefix = "scene.";
  std::string text;
  for (const SettingText& setting : method.settings()) {
    if (!setting.name.starts_with(kPrefix)) continue;
    text += (text.empty() ? "scene: " : ", ") + setting.name.substr(kPrefix.size()) + " " + setting.value;
  }
  return text + "\n";
}

/// The output that the options request for a compiled graph.
std::string describe(const GraphOptions& options, Denoiser& method, const fg::GraphDesc& graph, const fg::Plan& plan,
                     fg::Extent extent) {
  if (options.json) return fg::toJson(graph, plan) + "\n";
  if (options.dot) return fg::toDot(graph, plan);
  if (options.svg) return fg::toSvg(graph, plan);
  if (!options.why.empty()) return explain(options.why, graph, plan);
  return options.method.name + " at " + std::to_string(extent.width) + " x " + std::to_string(extent.height) +
         " pixels\n" + sceneText(method) + fg::toText(graph, plan);
}

void write(const std::string& text, const std::string& file) {
  if (file.empty()) {
    std::cout << text;
  } else {
    writeFileAtomically(file, text);
  }
}

/// @param lights  whose settings are listed
std::string settingsListing(Denoiser& method, LightKinds lights) {
  std::ostringstream text;
  for (const SettingText& setting : method.settings()) {
    if (!haveInCommon(setting.lights, lights)) continue;
    text << setting.name << " = " << setting.value << "  (" << setting.range
         << (setting.unit.empty() ? "" : " " + setting.unit) << ")\n    " << setting.description << " ["
         << setting.source << "]\n";
  }
  return text.str();
}

/// The method of the second diffuse light; null if there is none.
/// @throws UsageError if the method has no guides that lights could share
std::unique_ptr<Denoiser> makeSecond(const GraphOptions& options, LightKinds lights) {
  if (options.secondPreset.empty()) return nullptr;
  MethodOptions chosen = options.method;
  chosen.preset = options.secondPreset;
  std::unique_ptr<Denoiser> second = makeMethod(chosen, lights);
  if (!second->sharesGuides()) {
    throw UsageError("--second-preset: method " + options.method.name + " has no guides that lights could share");
  }
  return second;
}

/// @param second that of a second diffuse light; may be null
/// @throws UsageError if the method does not take specular light
std::vector<DenoisedLight> lightsOf(const GraphOptions& options, Denoiser& method, Denoiser* second) {
  if (options.lights == "specular" && !options.light.everyPixel()) {
    throw UsageError("--light specular marks pixels without a sample by a distance of 0: leave out --light-rate");
  }
  if (options.lights != "diffuse" && !method.takesSpecularLight()) {
    throw UsageError("--light " + options.lights + ": method " + options.method.name + " takes diffuse light only");
  }
  std::vector<DenoisedLight> lights;
  if (options.lights != "specular") lights.push_back({&method});
  if (second != nullptr) lights.push_back({second});
  if (options.lights != "diffuse") lights.push_back({&method, true});
  return lights;
}

void printGraph(const GraphOptions& options) {
  if ((options.listSettings || options.listPasses) &&
      (options.json || options.dot || options.svg || !options.why.empty())) {
    throw UsageError("--list-settings and --list-passes print text: leave out --json, --dot, --svg and --why");
  }
  if (options.listPasses) {
    return write(passListing(), options.output);
  }
  const fg::Extent extent = parseSize(options.size);
  const LightKinds kinds{.diffuse = options.lights != "specular", .specular = options.lights != "diffuse"};
  const std::unique_ptr<Denoiser> method = makeMethod(options.method, kinds);
  if (options.listSettings) {
    const LightKinds both{.diffuse = true, .specular = true};
    return write(settingsListing(*method, options.lights == "specular" ? kinds : both), options.output);
  }
  InputConventions conventions;
  conventions.light = options.light;
  const std::unique_ptr<Denoiser> second = makeSecond(options, kinds);
  const std::vector<DenoisedLight> lights = lightsOf(options, *method, second.get());
  const DenoiseGraph declared = declareDenoiseGraph(lights, extent, conventions, kComputeHost);
  const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  if (!result.ok()) {
    throw std::runtime_error("the method's frame graph does not compile:\n" + result.text());
  }
  write(describe(options, *method, declared.graph.desc(), result.plan, extent), options.output);
}

}  // namespace

void registerGraph(CLI::App& program) {
  const auto options = std::make_shared<GraphOptions>();
  CLI::App* command = program.add_subcommand(
      "graph", "Print a method's frame-graph plan: passes in order, textures with format and lifetime, memory");
  addMethodOptions(*command, options->method);
  CLI::Option* const light =
      command
          ->add_option("--light", options->lights,
                       "Light that is denoised: diffuse, specular, or all, which is both in one graph")
          ->check(CLI::IsMember({"diffuse", "specular", "all"}))
          ->option_text("diffuse|specular|all=diffuse");
  command
      ->add_option("--second-preset", options->secondPreset,
                   "Two lights that share their guides: the preset of the second. Settings count for both")
      ->type_name("NAME")
      ->excludes(light);
  command
      ->add_option("--size", options->size,
                   "Size of the image in pixels, 1 to 16384 each. Memory is computed from a table of formats, so no "
                   "device is needed")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  addLightRate(*command, options->light,
               "Share of the pixels that have a sample of light: 1, 1/2 (a checkerboard), 1/4 (one of 2 x 2) or 1/9 "
               "(one of 3 x 3)");
  CLI::Option_group* format = command->add_option_group("Format", "Instead of text");
  format->add_flag("--json", options->json,
                   "The whole plan as JSON: passes, textures, buffers, barriers, heaps, memory and traffic");
  format->add_flag("--dot", options->dot, "Passes and versions of textures as a Graphviz graph");
  format->add_flag("--svg", options->svg, "A chart of memory over passes");
  format
      ->add_option("--why", options->why,
                   "With a pass: why it is culled, or why each of its barriers exists. With two textures or buffers: "
                   "why they do or do not share memory")
      ->expected(1, 2)
      ->type_name("NAME");
  format->require_option(0, 1);
  command->add_option("--output", options->output, "Write to a file instead of standard output")->type_name("FILE");
  command->add_flag(
      "--list-settings", options->listSettings,
      "Instead of a plan, list the method's settings with value, range, unit and source; with --light specular, "
      "those that act on it");
  command->add_flag(
      "--list-passes", options->listPasses,
      "Instead of a plan, list all pass types that a host can create by name, with ports, settings and passes");
  command->footer(kExitCodeHelp);
  command->callback([options] { printGraph(*options); });
}

}  // namespace walr
