#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "samples/denoise/gpu_device.h"

namespace walr {

/// Adds `--device` and `--validate` to a subcommand, and keeps the device's compiled pipelines in the user's cache
/// folder (`pipelineCacheFile`).
/// @param caution what else to say of validation
void addDeviceOptions(CLI::App& command, GpuDevice::Options& options, const std::string& caution = {});

}  // namespace walr
