#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "passes/conventions/light_pattern.h"

namespace walr {

/// Adds `--light-rate` to a command: 1, 1/2 (a checkerboard), 1/4 (one of 2 x 2) or 1/9 (one of 3 x 3).
/// @param light       receives the pattern
/// @param description of the option
void addLightRate(CLI::App& command, LightPattern& light, const std::string& description);

/// Description of `--light-rate` for commands that read frames.
inline constexpr const char* kKeptLightHelp =
    "Take only this share of the samples of light: 1, 1/2 (a checkerboard), 1/4 or 1/9 (one of 2 x 2 or 3 x 3 "
    "pixels), other ones in each frame, to see what fewer rays would cost";

}  // namespace walr
