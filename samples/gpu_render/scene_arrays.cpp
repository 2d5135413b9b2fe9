#include "samples/gpu_render/scene_arrays.h"

#include <cmath>
#include <cstring>
#include <optional>

#include <glm/gtc/type_ptr.hpp>

namespace walr::gpu_render {
namespace {

template <typename Vector>
std::uint32_t append(std::vector<float>& floats, const std::vector<Vector>& values) {
  if (values.empty()) return kAbsent;
  const auto first = static_cast<std::uint32_t>(floats.size());
  const float* const begin = glm::value_ptr(values.front());
  floats.insert(floats.end(), begin, begin + values.size() * static_cast<std::size_t>(Vector::length()));
  return first;
}

void appendMesh(SceneArrays& arrays, const render::Mesh& mesh) {
  MeshData data{};
  data.positions = append(arrays.floats, mesh.positions);
  data.normals = append(arrays.floats, mesh.normals);
  data.uvs = append(arrays.floats, mesh.uvs);
  data.tangents = append(arrays.floats, mesh.tangents);
  data.colors = append(arrays.floats, mesh.colors);
  data.vertices = static_cast<std::uint32_t>(mesh.positions.size());
  data.triangles = static_cast<std::uint32_t>(arrays.indices.size());
  data.material = mesh.material;
  for (const glm::uvec3& triangle : mesh.triangles) {
    arrays.indices.insert(arrays.indices.end(), {triangle.x, triangle.y, triangle.z});
  }
  arrays.meshes.push_back(data);
}

MaterialData materialData(const render::Material& material) {
  const auto index = [](const std::optional<std::uint32_t>& texture) { return texture.value_or(kAbsent); };
  MaterialData data{};
  data.baseColor = glm::vec4(material.baseColor, material.baseAlpha);
  data.emission = glm::vec4(material.emission, material.alphaCutoff.value_or(0.0F));
  data.metallic = material.metallic;
  data.roughness = material.roughness;
  data.normalScale = material.normalScale;
  data.flags = (material.doubleSided ? kDoubleSided : 0) | (material.alphaCutoff ? kCutOut : 0) |
               (material.emits() ? kEmits : 0);
  data.baseColorTexture = index(material.baseColorTexture);
  data.metallicRoughnessTexture = index(material.metallicRoughnessTexture);
  data.emissiveTexture = index(material.emissiveTexture);
  data.normalTexture = index(material.normalTexture);
  return data;
}

void appendImages(SceneArrays& arrays, const render::Scene& scene) {
  std::vector<std::uint32_t> first;
  for (const render::Image& image : scene.images) {
    first.push_back(static_cast<std::uint32_t>(arrays.texels.size()));
    arrays.texels.resize(arrays.texels.size() + image.rgba.size() / sizeof(std::uint32_t));
    std::memcpy(arrays.texels.data() + first.back(), image.rgba.data(), image.rgba.size());
  }
  for (const render::Texture& texture : scene.textures) {
    const render::Image& image = scene.images[texture.image];
    const auto wraps = static_cast<std::uint32_t>(texture.wrapU) | static_cast<std::uint32_t>(texture.wrapV) << 2U;
    arrays.textures.push_back({first[texture.image], image.width, image.height,
                               wraps | (texture.nearest ? kNearest : 0) | texture.coordinates << kCoordinatesShift});
  }
}

}  // namespace

SceneArrays sceneArrays(const render::World& world) {
  const render::Scene& scene = world.scene();
  SceneArrays arrays;
  for (const render::Mesh& mesh : scene.meshes) appendMesh(arrays, mesh);
  for (const render::Material& material : scene.materials) arrays.materials.push_back(materialData(material));
  appendImages(arrays, scene);
  for (const render::ColorSpace space : {render::ColorSpace::Srgb, render::ColorSpace::Linear}) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) arrays.byteValues.push_back(render::valueOfByte(byte, space));
  }
  for (std::uint32_t i = 0; i < world.instances().size(); ++i) {
    if (!world.instances()[i].moves) arrays.stillInstances.push_back(i);
  }
  if (scene.skyMap) {
    append(arrays.sky, scene.skyMap->radiance);
    const render::Sky& sky = world.sky();
    arrays.sky.insert(arrays.sky.end(), sky.rows().begin(), sky.rows().end());
    arrays.sky.insert(arrays.sky.end(), sky.columns().begin(), sky.columns().end());
  }
  return arrays;
}

}  // namespace walr::gpu_render
