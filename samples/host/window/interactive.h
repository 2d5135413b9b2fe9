#pragma once

#include <memory>
#include <string>

#include "samples/denoise/gpu_device.h"
#include "samples/host/session.h"
#include "samples/host/tracer.h"
#include "samples/host/window/window.h"

namespace walr::host {

/// Options for a device that can show pictures in windows.
GpuDevice::Options withWindows(GpuDevice::Options options);

/// Show the session in a window until the user closes it or ends the program.
/// @param extent  size of the picture, which is that of the tracer
void runWindow(Tracer& tracer, GpuDevice& device, Session& session, fg::Extent extent);

}  // namespace walr::host
