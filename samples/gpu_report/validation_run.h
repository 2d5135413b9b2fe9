#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framegraph/vulkan/messages.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// What the validation layer says of all methods.
struct ValidationRun {
  bool layer = false;  ///< The Khronos validation layer is installed; it then also validates synchronization.
  std::string whyNot;  ///< Why there was no validation; empty if there was.
  std::vector<std::string> methods;  ///< The variants that ran.
  std::vector<fg::vk::Message> messages;
};

/// Run every method for a few frames of a small picture, once with uploads and readbacks and once as it is timed, and
/// the probes of the bandwidth, under the Khronos validation layer with synchronization validation.
/// @param options of the device; its validation is switched on
/// @throws fg::vk::Error if the device fails, but not if the layer is missing
ValidationRun validate(GpuDevice::Options options, std::span<const Variant> variants);

}  // namespace walr
