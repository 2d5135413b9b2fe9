#pragma once

#include <cstdint>
#include <vector>

#include "samples/gpu_render/shaders/scene_data.h"
#include "samples/render/world.h"

namespace walr::gpu_render {

/// What of a scene does not change from frame to frame, as the shader reads it.
struct SceneArrays {
  std::vector<float> floats;           ///< Positions, normals and other attributes of all meshes.
  std::vector<std::uint32_t> indices;  ///< Of the triangles of all meshes.
  std::vector<MeshData> meshes;
  std::vector<MaterialData> materials;
  std::vector<TextureData> textures;
  std::vector<std::uint32_t> texels;  ///< Of all images, RGBA8.
  std::vector<float> byteValues;      ///< Linear values of the 256 sRGB-encoded bytes, then of linear bytes.
  std::vector<std::uint32_t> stillInstances;
  std::vector<float> sky;  ///< See shaders/sky.glsl.
};

SceneArrays sceneArrays(const render::World& world);

}  // namespace walr::gpu_render
