#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace walr {

/// The command line of a subcommand, so that a user can repeat the run.
std::string commandLine(const CLI::App& program, const CLI::App& command);

}  // namespace walr
