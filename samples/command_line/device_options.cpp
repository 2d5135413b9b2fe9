#include "samples/command_line/device_options.h"

namespace walr {

void addDeviceChoice(CLI::App& command, GpuDevice::Options& options) {
  options.keepPipelines = true;
  command
      .add_option("--device", options.device,
                  "Vulkan device by number or part of its name; default: the most capable one")
      ->type_name("N|NAME");
}

void addDeviceOptions(CLI::App& command, GpuDevice::Options& options, const std::string& caution) {
  addDeviceChoice(command, options);
  command.add_flag("--validate", options.validation,
                   "Run under the Khronos validation layer with synchronization validation; any message is an error" +
                       (caution.empty() ? "" : ". " + caution));
}

}  // namespace walr
