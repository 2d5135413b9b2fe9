#pragma once

#include <cstdint>
#include <optional>

#include "samples/denoise/gpu_device.h"

namespace walr {

/// Device-local memory as the driver counts it (VK_EXT_memory_budget), in bytes.
struct DeviceMemory {
  std::uint64_t used = 0;    ///< By this program, images of windows and the driver's own objects included.
  std::uint64_t budget = 0;  ///< What this program may use before allocations fail or become slow.
};

/// @returns nothing if the device does not have the extension
std::optional<DeviceMemory> deviceMemory(const GpuDevice& gpu);

}  // namespace walr
