#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "samples/denoise/gpu_device.h"

namespace walr {

/// Adds `--device` and `--validate` to a subcommand, and stores compiled pipelines in the user's cache folder
/// (`pipelineCacheFile`).
/// @param caution sentence to add to the help of `--validate`; may be empty
void addDeviceOptions(CLI::App& command, GpuDevice::Options& options, const std::string& caution = {});

}  // namespace walr
