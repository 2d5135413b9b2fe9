#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "passes/denoiser.h"

namespace walr {

/// Which method to run, and with which settings.
struct MethodOptions {
  std::string name = "walr";
  std::string preset;                 ///< Empty: the method's first.
  bool spatialOnly = false;           ///< Each frame by itself.
  std::vector<std::string> settings;  ///< "name=value" each.
};

/// Adds `--method`, `--preset`, `--spatial-only` and `--set` to a subcommand.
void addMethodOptions(CLI::App& command, MethodOptions& options);

/// Make the method.
/// @throws UsageError naming the unknown preset, or the setting that is unknown, out of range or not of the form
/// name=value
std::unique_ptr<Denoiser> makeMethod(const MethodOptions& options);

/// The preset whose settings a method has now, all of them. Nothing where there is none.
std::optional<std::string> presetInUse(std::string_view methodName, Denoiser& method);

}  // namespace walr
