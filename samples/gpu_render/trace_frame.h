#pragma once

#include <cstddef>
#include <vector>

#include <vulkan/vulkan_core.h>

#include "samples/gpu_render/shaders/scene_data.h"
#include "samples/render/film.h"
#include "samples/render/reference.h"
#include "samples/render/view.h"
#include "samples/render/world.h"

namespace walr::gpu_render {

/// What of a scene changes from frame to frame, as the shader reads it.
struct SceneState {
  std::vector<InstanceData> instances;
  std::vector<PunctualLightData> punctualLights;
  std::vector<EmitterData> emitters;
};

/// The number of triangles of emissive materials: the largest number of emitters at any time. A lamp without size is
/// none.
std::size_t emissiveTriangles(const render::World& world);

/// @returns arrays of the same sizes at any time: unused emitters are zeros
SceneState sceneState(const render::World& world);

/// The constants of a frame.
/// @throws render::SceneError naming a setting that the GPU's path tracer does not have
TraceConstants traceConstants(const render::World& world, const render::View& view,
                              const render::SamplingSettings& settings, const render::ReferenceCoverage& coverage = {});

}  // namespace walr::gpu_render
