#pragma once

#include <filesystem>
#include <functional>

#include "samples/denoise/gpu_device.h"
#include "samples/host/renderer.h"
#include "samples/host/tracer.h"
#include "samples/sequence/sequence.h"

namespace walr::host {

/// Calls `use` for every frame of an animation, rendered, in order. The next frame is traced while the device works.
/// @param request  what to trace; number and place in the animation are those of the frames
void renderFrames(Tracer& tracer, Renderer& renderer, const FrameRange& frames, Tracer::Request request,
                  const std::function<void(const RenderedFrame&)>& use);

/// Write `frame_FFFF.png`, what is shown, and where the composite was read back `frame_FFFF.exr`, the linear lit
/// picture.
/// @throws OutputError; every file is whole or absent
void writeRenderedFrame(const RenderedFrame& frame, fg::Extent extent, const std::filesystem::path& directory);

}  // namespace walr::host
