#include "samples/command_line/exit_code.h"

#include <new>

#include "framegraph/vulkan/error.h"
#include "samples/command_line/usage_error.h"
#include "samples/errors.h"

namespace walr {

ExitCode exitCode(const std::exception& error) {
  if (dynamic_cast<const UsageError*>(&error) != nullptr) {
    return ExitCode::Usage;
  }
  if (dynamic_cast<const InputError*>(&error) != nullptr) {
    return ExitCode::Input;
  }
  if (dynamic_cast<const OutputError*>(&error) != nullptr) {
    return ExitCode::Output;
  }
  // The processor's memory is what a software device and the copies of frames use.
  if (dynamic_cast<const fg::vk::Error*>(&error) != nullptr || dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
    return ExitCode::Device;
  }
  return ExitCode::Internal;
}

}  // namespace walr
