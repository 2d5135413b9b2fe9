#include "samples/command_line/device_options.h"

namespace walr {

void addDeviceOptions(CLI::App& command, GpuDevice::Options& options, const std::string& caution) {
  options.keepPipelines = true;
  command
      .add_option("--device", options.device,
                  "Vulkan device by number or part of its name; default: the most capable one")
      ->type_name("N|NAME");
  command.add_flag("--validate", options.validation,
                   "Run under the Khronos validation layer with synchronization validation; any message is an error" +
                       (caution.empty() ? "" : ". " + caution));
}

}  // namespace walr
