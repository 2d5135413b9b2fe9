#include "samples/command_line/tracer_option.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/vulkan/error.h"
#include "samples/command_line/choice.h"

namespace walr {

void addTracerOption(CLI::App& command, TracerChoice& choice) {
  const std::vector<std::pair<std::string, TracerChoice>> names{
      {"cpu", TracerChoice::Cpu}, {"gpu", TracerChoice::Gpu}, {"auto", TracerChoice::Auto}};
  const auto initial = std::ranges::find(names, choice, [](const auto& named) { return named.second; });
  addChoice(command, "--tracer", choice, names, initial->first,
            "Where paths are traced: cpu (Embree), gpu (a Vulkan device with ray queries) or auto (gpu if the "
            "device has ray queries and is no software driver, otherwise cpu)");
}

TracerDecision decideTracer(TracerChoice choice, const GpuDevice& gpu) {
  if (choice == TracerChoice::Cpu) return {false, "CPU (Embree)"};
  const std::string& missing = gpu.missingForRayQueries();
  if (choice == TracerChoice::Gpu) {
    if (missing.empty()) return {true, "GPU (ray queries)"};
    throw fg::vk::Unsupported("--tracer gpu: the device '" + gpu.name() + "' lacks " + missing +
                              "; use --tracer cpu, or another --device");
  }
  if (!missing.empty()) return {false, "CPU (Embree), because the device lacks " + missing};
  if (gpu.isSoftware()) return {false, "CPU (Embree), because the device is a software driver"};
  return {true, "GPU (ray queries)"};
}

}  // namespace walr
