#pragma once

#include <memory>
#include <string>

#include "samples/denoise/gpu_device.h"
#include "samples/host/headless.h"
#include "samples/host/session.h"
#include "samples/host/tracer.h"
#include "samples/host/window/window.h"

namespace walr::host {

/// Add the extensions to `options` that a device needs to present to windows.
GpuDevice::Options withWindows(GpuDevice::Options options);

/// Show the session in a window until the user closes it or interrupts the program.
/// @param extent  size of the image, the same as that of the tracer
/// @param reload  called before every frame; may be empty
void runWindow(Tracer& tracer, GpuDevice& device, Session& session, fg::Extent extent, const ReloadShaders& reload);

}  // namespace walr::host
