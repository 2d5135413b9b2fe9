#pragma once

#include <CLI/CLI.hpp>

namespace walr {

/// Parse the command line, run its callbacks and turn what they throw into a message and an exit code. The program's
/// name stands before every message.
int runProgram(CLI::App& program, int argc, char** argv);

}  // namespace walr
