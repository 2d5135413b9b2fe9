#pragma once

#include <array>

#include <CLI/CLI.hpp>

namespace walr {

/// Adds one subcommand to the program: its options, and a callback that runs it. The callback reports errors as
/// exceptions, which `exitCode` maps to exit codes.
using RegisterCommand = void (*)(CLI::App& program);

void registerBench(CLI::App& program);
void registerDenoise(CLI::App& program);
void registerGpuReport(CLI::App& program);
void registerGraph(CLI::App& program);
void registerLint(CLI::App& program);
void registerRender(CLI::App& program);

/// All subcommands of `walr`. A new subcommand needs one line here.
inline constexpr std::array<RegisterCommand, 6> kCommands = {
    registerBench, registerDenoise, registerGpuReport, registerGraph, registerLint, registerRender,
};

}  // namespace walr
