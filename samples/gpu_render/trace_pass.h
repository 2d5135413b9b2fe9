#pragma once

#include <array>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/executor.h"
#include "samples/gpu_render/gpu_scene.h"
#include "samples/gpu_render/trace_frame.h"

/// The path tracer as a pass of a frame graph.
namespace walr::gpu_render {

/// What is uploaded for a frame.
struct TraceData {
  SceneState state;
  std::vector<VkAccelerationStructureInstanceKHR> placements;
  TraceConstants constants{};
};

/// The upload buffers of the pass.
struct TraceInputs {
  fg::Buffer instances;
  fg::Buffer punctualLights;
  fg::Buffer emitters;
  fg::Buffer placements;
  fg::Buffer constants;
};

/// What the pass writes, all of the image's size. Where not stated otherwise, the format is that of the `Precision`,
/// and the values are those of `render::Film`.
struct TracedTextures {
  fg::Texture direct;    ///< Mean direct light; alpha: number of paths.
  fg::Texture indirect;  ///< Mean indirect light; alpha: number of rays.
  fg::Texture normal;
  fg::Texture albedo;
  fg::Texture emission;
  fg::Texture motion;
  fg::Texture depth;                ///< R32F: linear view depth; `kBackgroundDepth` on sky.
  fg::Texture objectId;             ///< R32UI: index of the instance; 0xffffffff on sky.
  fg::Texture specular = {};        ///< See shaders/trace.comp; only with `Scene::specular`.
  fg::Texture specularAlbedo = {};  ///< The same.
  fg::Texture specularMotion = {};  ///< The same.

  /// The format of the textures without one of their own.
  static VkFormat format(Precision precision);
};

/// Name of the pass that `addTrace` adds.
inline constexpr const char* kTracePass = "trace";

TraceInputs declareTraceInputs(fg::Graph& graph, const GpuScene& scene);

/// Add a pass that builds the top-level acceleration structure and traces a frame. Barriers for the structure are
/// recorded inside the pass; nothing else uses it.
/// @param scene     must outlive the graph and its executors
/// @param textures  replaced by the written versions
void addTrace(fg::Graph& graph, const GpuScene& scene, Precision precision, const TraceInputs& inputs,
              TracedTextures& textures);

/// Upload what changes, for the frame that is recorded next.
void uploadTrace(fg::vk::Executor& executor, const TraceInputs& inputs, const TraceData& data);

}  // namespace walr::gpu_render
