#pragma once

#include <exception>

namespace walr {

/// Exit codes of `walr`, for scripts.
enum class ExitCode {
  Success = 0,
  Internal = 1,  ///< Any error without a code of its own.
  Usage = 2,     ///< The command line is wrong.
  Input = 3,     ///< Input is missing, damaged or inconsistent.
  Device = 4,    ///< No Vulkan device, or the device lacks a feature or fails; or memory runs out.
  Output = 5,    ///< Output cannot be written.
};

/// The table of exit codes, for help texts.
inline constexpr const char* kExitCodeHelp =
    "Exit codes: 0 success, 1 internal error, 2 wrong command line, 3 bad input, 4 Vulkan device, 5 output not "
    "writable.";

ExitCode exitCode(const std::exception& error);

}  // namespace walr
