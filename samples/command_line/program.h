#pragma once

#include <CLI/CLI.hpp>

namespace walr {

/// Parse the command line and run its callbacks. An exception becomes a message, preceded by the program's name, and an
/// exit code.
int runProgram(CLI::App& program, int argc, char** argv);

}  // namespace walr
