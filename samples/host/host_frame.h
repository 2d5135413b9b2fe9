#pragma once

#include <optional>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/denoise/packed_frame.h"
#include "samples/gpu_render/trace_pass.h"
#include "samples/host/traced_rays.h"

namespace walr::host {

/// A frame with its images in the formats of the host's textures, or what the device needs to trace it.
struct HostFrame {
  fg::Extent extent;
  PackedFrame inputs;  ///< Inputs of the denoiser; `inputs.frame.number` is its random seed.
  FrameConstants constants{};
  /// For a graph that traces (`HostGraph::trace`). All images are then empty.
  std::optional<gpu_render::TraceData> trace;
  TracedRays traced;               ///< On the processor; nothing if the device traces.
  std::vector<Rgba16> noisyLight;  ///< Sparse light for all pixels, 0 without a sample; empty if light is not sparse.
  std::vector<Rgba16> direct;
  std::vector<Rgba16> emission;
  PackedLight specular;                 ///< Empty without specular light.
  std::vector<Rgba16> referenceDirect;  ///< For the split view; empty otherwise.
  std::vector<Rgba16> referenceIndirect;
  std::vector<Rgba16> referenceSpecular;
};

HostFrame packHostFrame(Frame frame);

/// A frame that the device traces.
/// @param frame  without images
HostFrame hostFrameToTrace(Frame frame, gpu_render::TraceData trace);

}  // namespace walr::host
