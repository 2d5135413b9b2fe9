#pragma once

#include <optional>
#include <string>

#include "samples/bench/spread.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// The device of the measurements, with the properties of its timer and memory.
struct DeviceFacts {
  std::string name;
  std::string driver;
  bool software = false;  ///< The device is a CPU implementation of Vulkan: its times do not predict those of a GPU.
  double timestampNanoseconds = 0.0;         ///< Resolution of the timer.
  std::optional<Spread> timerMilliseconds;   ///< Measured time of an empty pass; absent without a timer.
  std::optional<double> copyBytesPerSecond;  ///< Bytes read plus written by buffer copies of 64 MiB, median.
};

/// Measure these properties. Takes well under a second.
/// @throws fg::vk::Error when the device fails
DeviceFacts deviceFacts(const GpuDevice& device);

}  // namespace walr
