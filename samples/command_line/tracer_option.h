#pragma once

#include <cstdint>
#include <string>

#include <CLI/CLI.hpp>

#include "samples/denoise/gpu_device.h"

namespace walr {

/// Values of `--tracer`: where paths are traced.
enum class TracerChoice : std::uint8_t {
  Cpu,   ///< On the processor, with Embree.
  Gpu,   ///< On the Vulkan device, with ray queries.
  Auto,  ///< On the Vulkan device if it has ray queries and is not a program on the processor; otherwise with Embree.
};

/// Adds `--tracer` with the default that `choice` holds.
void addTracerOption(CLI::App& command, TracerChoice& choice);

/// Whether a choice may lead to the Vulkan device, so that it needs `GpuDevice::Options::rayQueries`.
inline bool mayTraceOnGpu(TracerChoice choice) {
  return choice != TracerChoice::Cpu;
}

/// Where paths are traced on a device, and why.
struct TracerDecision {
  bool onGpu = false;
  std::string text;  ///< "GPU (ray queries)", or "CPU (Embree)" with the reason.
};

/// @param gpu  made with `rayQueries` if `mayTraceOnGpu`
/// @throws fg::vk::Unsupported naming what the device lacks, for `TracerChoice::Gpu`
TracerDecision decideTracer(TracerChoice choice, const GpuDevice& gpu);

}  // namespace walr
