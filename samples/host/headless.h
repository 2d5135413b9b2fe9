#pragma once

#include <filesystem>
#include <functional>

#include "samples/denoise/gpu_device.h"
#include "samples/host/renderer.h"
#include "samples/host/tracer.h"
#include "samples/sequence/sequence.h"

namespace walr::host {

/// Reloads shaders of a graph whose sources have changed. Returns the number of shaders that the executor got.
using ReloadShaders = std::function<std::size_t(const fg::GraphDesc&, fg::vk::Executor&)>;

/// Renders the frames of an animation in order and calls `use` for each. The next frame is traced, or prepared for
/// tracing, while the device works.
/// @param request  what to trace; its frame number and animation frame are replaced by those of each frame
void renderFrames(Tracer& tracer, Renderer& renderer, const FrameRange& frames, Tracer::Request request,
                  const std::function<void(const RenderedFrame&)>& use);

/// Write `frame_FFFF.png`, the displayed image, and, if the composite was read back, `frame_FFFF.exr`, the linear lit
/// image.
/// @throws OutputError; every file is either complete or absent
void writeRenderedFrame(const RenderedFrame& frame, fg::Extent extent, const std::filesystem::path& directory);

}  // namespace walr::host
