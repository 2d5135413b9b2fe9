#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "samples/denoise/gpu_device.h"

namespace walr {

/// Adds `--device` to a subcommand, and stores compiled pipelines in the user's cache folder (`pipelineCacheFile`).
void addDeviceChoice(CLI::App& command, GpuDevice::Options& options);

/// Adds `--device` and `--validate` to a subcommand, and stores compiled pipelines like `addDeviceChoice`.
/// @param caution sentence to add to the help of `--validate`; may be empty
void addDeviceOptions(CLI::App& command, GpuDevice::Options& options, const std::string& caution = {});

}  // namespace walr
