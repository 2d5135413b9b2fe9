#pragma once

#include <optional>
#include <string>

#include "samples/bench/spread.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// The device that times were taken on, and what its clock and memory can do.
struct DeviceFacts {
  std::string name;
  std::string driver;
  bool software = false;                     ///< A processor plays the GPU: times say nothing about one.
  double timestampNanoseconds = 0.0;         ///< The timer's resolution.
  std::optional<Spread> timerMilliseconds;   ///< What it shows for a pass that does nothing; absent without a timer.
  std::optional<double> copyBytesPerSecond;  ///< Bytes read and written by buffer copies of 64 MiB, median.
};

/// Measures in well under a second.
/// @throws fg::vk::Error when the device fails
DeviceFacts deviceFacts(const GpuDevice& device);

}  // namespace walr
