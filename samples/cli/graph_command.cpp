#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>

#include "framegraph/compile.h"
#include "framegraph/inspect.h"
#include "integration/denoise_graph.h"
#include "integration/registry.h"
#include "samples/cli/arguments.h"
#include "samples/cli/command.h"
#include "samples/cli/exit_code.h"
#include "samples/cli/method_options.h"

namespace walr {
namespace {

struct GraphOptions {
  MethodOptions method;
  std::string size = "1920x1080";
  bool listSettings = false;
  bool listPasses = false;
};

void listSettings(Denoiser& method) {
  for (const SettingText& setting : method.settings()) {
    std::cout << setting.name << " = " << setting.value << "  (" << setting.range
              << (setting.unit.empty() ? "" : " " + setting.unit) << ")\n    " << setting.description << " ["
              << setting.source << "]\n";
  }
}

void printGraph(const GraphOptions& options) {
  if (options.listPasses) {
    std::cout << passListing();
    return;
  }
  const fg::Extent extent = parseSize(options.size);
  const std::unique_ptr<Denoiser> method = makeMethod(options.method);
  if (options.listSettings) {
    listSettings(*method);
    return;
  }
  const DenoiseGraph declared = declareDenoiseGraph(*method, extent, InputConventions{}, kComputeHost);
  const fg::CompileResult result = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  if (!result.ok()) {
    throw std::runtime_error("the method's frame graph does not compile:\n" + result.text());
  }
  std::cout << options.method.name << " at " << extent.width << " x " << extent.height << " pixels\n"
            << fg::toText(declared.graph.desc(), result.plan);
}

}  // namespace

void registerGraph(CLI::App& program) {
  const auto options = std::make_shared<GraphOptions>();
  CLI::App* command = program.add_subcommand(
      "graph", "Print a method's frame-graph plan: passes in order, textures with format and lifetime, memory");
  addMethodOptions(*command, options->method);
  command
      ->add_option(
          "--size", options->size,
          "Size of the picture in pixels, 1 to 16384 each. Memory is computed from a table of formats, so that "
          "no device is needed")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  command->add_flag("--list-settings", options->listSettings,
                    "List the method's settings with value, range, unit and source instead");
  command->add_flag("--list-passes", options->listPasses,
                    "List all pass types that a host can create by name, with ports, settings and passes, instead");
  command->footer(kExitCodeHelp);
  command->callback([options] { printGraph(*options); });
}

}  // namespace walr
