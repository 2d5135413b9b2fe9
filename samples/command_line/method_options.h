#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "passes/methods/denoiser.h"

namespace walr {

/// Which method to run, and with which settings.
struct MethodOptions {
  std::string name = "walr";
  std::string preset;                 ///< Empty: the method's first.
  bool spatialOnly = false;           ///< Filter each frame separately.
  std::vector<std::string> settings;  ///< Each is "name=value".
};

/// Adds `--method`, `--preset`, `--spatial-only` and `--set` to a subcommand.
void addMethodOptions(CLI::App& command, MethodOptions& options);

/// Create the method with its preset and settings.
/// @param lights that are denoised
/// @throws UsageError naming an unknown preset, or a setting that is unknown, out of range, not of the form name=value,
/// or without effect on these lights
std::unique_ptr<Denoiser> makeMethod(const MethodOptions& options, LightKinds lights);

/// The preset whose values all settings of a method have now; nullopt if there is none.
std::optional<std::string> presetInUse(std::string_view methodName, Denoiser& method);

}  // namespace walr
