#include "tests/costs/figures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "passes/methods/denoiser.h"
#include "samples/bench/plan_costs.h"

namespace walr::costs {
namespace {

/// The name of a method in the benchmark's reports, where that of its first preset is left out, and its lights.
std::string variantName(MethodName name) {
  const std::vector<std::string> presets = makeDenoiser(name.method)->presets();
  if (!presets.empty() && name.preset == presets.front()) name.preset.clear();
  return name.text();
}

MethodEstimate estimateOf(const MethodCosts& method, const Machine& machine) {
  double bytes = 0.0;
  for (const PassCosts& pass : method.passes) bytes += static_cast<double>(pass.bytes);
  return {.variant = variantName(method.name),
          .cyclesPerPixel = method.cyclesPerPixel(),
          .megabytes = bytes * 1e-6,
          .memoryMegabytes = static_cast<double>(method.memoryBytes) * 1e-6,
          .microseconds = method.microseconds(machine)};
}

std::string pipelineName(const ShaderFigures& figures) {
  std::string text = "pipeline '" + figures.shader + "' with the specialization constants";
  for (const std::uint32_t word : figures.specialization) text += " " + std::to_string(word);
  return text;
}

/// One line per entry that differs from its counterpart or has none.
template <typename Entry, typename Same, typename Name>
void compare(const std::vector<Entry>& committed, const std::vector<Entry>& now, Same same, Name name,
             std::vector<std::string>& lines) {
  for (const Entry& entry : now) {
    if (std::ranges::none_of(committed, [&](const Entry& other) { return same(entry, other); })) {
      lines.push_back(name(entry) + " has other figures now, or none in the table");
    }
  }
  for (const Entry& entry : committed) {
    if (std::ranges::none_of(now, [&](const Entry& other) { return name(entry) == name(other); })) {
      lines.push_back(name(entry) + " is in the table, and no method has it");
    }
  }
}

}  // namespace

FigureTable figuresOf(const std::vector<MethodCosts>& methods, NullDevice& device, const TripCounts& trips,
                      const Machine& machine) {
  FigureTable table = {.driver = device.driver(),
                       .family = device.family(),
                       .shaders = {},
                       .machine = machine.name,
                       .extent = methods.at(0).extent,
                       .estimates = {}};
  const auto addPipelines = [&](const MethodCosts& method) {
    for (const PassCosts& pass : method.passes) {
      const ShaderFigures figures = {.shader = pass.shader,
                                     .specialization = pass.specialization,
                                     .waves = pass.compiled.waves,
                                     .wave = pass.wave};
      if (std::ranges::find(table.shaders, figures) == table.shaders.end()) table.shaders.push_back(figures);
    }
  };
  for (const MethodCosts& method : methods) {
    table.estimates.push_back(estimateOf(method, machine));
    addPipelines(method);
    for (const fg::Extent extent : kCommonExtents) {
      try {
        addPipelines(methodCosts(method.name, extent, device, trips));
      } catch (const std::invalid_argument&) {  // The method takes no picture that large, and has no figures there.
      }
    }
  }
  std::ranges::sort(table.shaders, {},
                    [](const ShaderFigures& figures) { return std::pair(figures.shader, figures.specialization); });
  return table;
}

std::vector<std::string> differences(const FigureTable& committed, const FigureTable& now) {
  std::vector<std::string> lines;
  compare(committed.shaders, now.shaders, std::equal_to<>(), pipelineName, lines);
  // The file holds estimates with one decimal.
  const auto sameEstimate = [](const MethodEstimate& a, const MethodEstimate& b) {
    const auto near = [](const std::optional<double>& x, const std::optional<double>& y) {
      return x.has_value() == y.has_value() && (!x || std::abs(*x - *y) < 0.1);
    };
    return a.variant == b.variant && near(a.cyclesPerPixel, b.cyclesPerPixel) && near(a.megabytes, b.megabytes) &&
           near(a.memoryMegabytes, b.memoryMegabytes) && near(a.microseconds, b.microseconds);
  };
  compare(
      committed.estimates, now.estimates, sameEstimate,
      [](const MethodEstimate& estimate) { return "the estimate of " + estimate.variant; }, lines);
  return lines;
}

}  // namespace walr::costs
