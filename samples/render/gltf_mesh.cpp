#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/gltf_accessor.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/scene_error.h"
#include "samples/render/tangents.h"

namespace walr::render::gltf {
namespace {

// With this limit, squares and products of two coordinates stay finite in float.
constexpr float kLargestCoordinate = 1e12F;

std::optional<int> findAttribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? std::nullopt : std::optional(found->second);
}

// Before the attribute is read: a file may claim any number.
void checkCount(const tinygltf::Model& model, int accessor, const Mesh& mesh, const std::string& what) {
  const std::size_t count = elementCount(model, accessor, what);
  if (count != mesh.positions.size()) {
    throw SceneError(what + ": has " + std::to_string(count) + " elements for " +
                     std::to_string(mesh.positions.size()) + " positions");
  }
}

// The triangles of a list, strip or fan of vertices (specification, 3.7.2.1).
std::vector<glm::uvec3> assemble(const std::vector<std::uint32_t>& vertices, int mode, const std::string& name) {
  const bool list = mode == TINYGLTF_MODE_TRIANGLES;
  if (list ? vertices.size() % 3 != 0 : vertices.size() < 3) {
    throw SceneError(name + ": has " + std::to_string(vertices.size()) + " indices, " +
                     (list ? "which is not a multiple of 3" : "but a strip or fan has at least 3"));
  }
  std::vector<glm::uvec3> triangles(list ? vertices.size() / 3 : vertices.size() - 2);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<std::size_t, 3> corners = {3 * i, 3 * i + 1, 3 * i + 2};
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) corners = {i, i + 1 + i % 2, i + 2 - i % 2};
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) corners = {i + 1, i + 2, 0};
    triangles[i] = {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]};
  }
  return triangles;
}

std::vector<glm::uvec3> readTriangles(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                      std::size_t vertices, const std::string& name) {
  std::vector<std::uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = readIndices(model, primitive.indices, name + " indices");
  } else {
    for (std::size_t i = 0; i < vertices; ++i) {
      indices.push_back(static_cast<std::uint32_t>(i));
    }
  }
  for (const std::uint32_t index : indices) {
    if (index >= vertices) {
      throw SceneError(name + ": index " + std::to_string(index) + " exceeds its " + std::to_string(vertices) +
                       " vertices");
    }
  }
  return assemble(indices, primitive.mode, name);
}

// Of attributes that only shade. Exporters write NaN where they divided by zero.
void warnOfFlaws(std::size_t flawed, const std::string& what, Scene& scene) {
  if (flawed > 0) {
    scene.warnings.push_back(what + ": " + std::to_string(flawed) + " values are not finite; they are read as zeros");
  }
}

bool hasDirection(const glm::vec3& vector) {
  const float length = glm::length(vector);
  return length > 0.0F && std::isfinite(length);
}

// Exporters write zeros or NaN for vertices of triangles without area. Those get the mean normal of their triangles,
// weighted by area.
void readNormals(const tinygltf::Model& model, int accessor, const std::string& what, Mesh& mesh, Scene& scene) {
  std::vector<glm::vec3>& normals = mesh.normals;
  std::size_t flawed = 0;
  normals = readVec3s(model, accessor, what, &flawed);
  const auto bad = std::ranges::count_if(normals, [](const glm::vec3& n) { return !hasDirection(n); });
  if (bad > 0) {
    scene.warnings.push_back(what + ": " + std::to_string(bad) + " of " + std::to_string(normals.size()) +
                             " have no direction; they get that of their triangles");
    std::vector<glm::vec3> sums(normals.size(), glm::vec3(0.0F));
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 origin = mesh.positions[t.x];
      const glm::vec3 doubleArea = glm::cross(mesh.positions[t.y] - origin, mesh.positions[t.z] - origin);
      for (const std::uint32_t vertex : {t.x, t.y, t.z}) sums[vertex] += doubleArea;
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!hasDirection(normals[i])) normals[i] = hasDirection(sums[i]) ? sums[i] : glm::vec3(0.0F, 0.0F, 1.0F);
    }
  }
  for (glm::vec3& normal : normals) normal /= glm::length(normal);
}

// Linear, clamped to 0..1, with alpha 1 if there is none (specification, 3.7.2.1).
std::vector<glm::vec4> readColors(const tinygltf::Model& model, int accessor, const std::string& what, Scene& scene) {
  std::size_t flawed = 0;
  std::vector<glm::vec4> colors;
  if (model.accessors[static_cast<std::size_t>(accessor)].type == TINYGLTF_TYPE_VEC3) {
    for (const glm::vec3& color : readVec3s(model, accessor, what, &flawed)) colors.emplace_back(color, 1.0F);
  } else {
    colors = readVec4s(model, accessor, what, &flawed);
  }
  warnOfFlaws(flawed, what, scene);
  for (glm::vec4& color : colors) color = glm::clamp(color, 0.0F, 1.0F);
  return colors;
}

// Appends the set of coordinates to the mesh.
void readTextureCoordinates(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                            const TextureCoordinates& coordinates, Mesh& mesh, Scene& scene) {
  const std::string attribute = "TEXCOORD_" + std::to_string(coordinates.set);
  std::vector<glm::vec2> uvs(mesh.positions.size(), glm::vec2(0.0F));
  if (const std::optional<int> uv = findAttribute(primitive, attribute)) {
    checkCount(model, *uv, mesh, mesh.name + " " + attribute);
    std::size_t flawed = 0;
    uvs = readVec2s(model, *uv, mesh.name + " " + attribute, &flawed);
    warnOfFlaws(flawed, mesh.name + " " + attribute, scene);
  } else {
    scene.warnings.push_back(mesh.name + ": has no " + attribute + " for its textures; they are sampled at the origin");
  }
  for (const glm::vec2& uv : uvs) mesh.uvs.push_back(coordinates.transform * glm::vec3(uv, 1.0F));
}

Mesh convertPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& name,
                      Scene& scene) {
  const std::optional<int> position = findAttribute(primitive, "POSITION");
  if (!position) {
    throw SceneError(name + ": has no POSITION attribute");
  }
  Mesh mesh;
  mesh.name = name;
  mesh.positions = readVec3s(model, *position, name + " POSITION");
  for (const glm::vec3& p : mesh.positions) {
    const glm::vec3 size = glm::abs(p);
    if (std::max({size.x, size.y, size.z}) > kLargestCoordinate) {
      throw SceneError(name + " POSITION: has a coordinate beyond 1e12");
    }
  }
  mesh.triangles = readTriangles(model, primitive, mesh.positions.size(), name);

  const std::size_t defaultMaterial = scene.materials.size() - 1;
  if (primitive.material >= 0 && static_cast<std::size_t>(primitive.material) >= defaultMaterial) {
    throw SceneError(name + ": there is no material " + std::to_string(primitive.material));
  }
  mesh.material = primitive.material >= 0 ? static_cast<std::uint32_t>(primitive.material)
                                          : static_cast<std::uint32_t>(defaultMaterial);
  const Material& material = scene.materials[mesh.material];

  if (const std::optional<int> normal = findAttribute(primitive, "NORMAL")) {
    checkCount(model, *normal, mesh, name + " NORMAL");
    readNormals(model, *normal, name + " NORMAL", mesh, scene);
  }
  for (const TextureCoordinates& coordinates : material.coordinates) {
    readTextureCoordinates(model, primitive, coordinates, mesh, scene);
  }
  if (const std::optional<int> color = findAttribute(primitive, "COLOR_0")) {
    checkCount(model, *color, mesh, name + " COLOR_0");
    mesh.colors = readColors(model, *color, name + " COLOR_0", scene);
  }
  // Last, because it may add vertices.
  if (material.normalTexture && !mesh.normals.empty()) {
    if (const std::optional<int> tangent = findAttribute(primitive, "TANGENT")) {
      checkCount(model, *tangent, mesh, name + " TANGENT");
      std::size_t flawed = 0;
      mesh.tangents = readVec4s(model, *tangent, name + " TANGENT", &flawed);
      warnOfFlaws(flawed, name + " TANGENT", scene);
    } else {
      deriveTangents(mesh, scene.textures[*material.normalTexture].coordinates);
    }
  } else if (material.normalTexture) {
    scene.warnings.push_back(name + ": a normal map needs NORMAL; it is not used");
  }
  if (!primitive.targets.empty()) {
    scene.warnings.push_back(name + ": morph targets are ignored");
  }
  return mesh;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> convertMeshes(const tinygltf::Model& model, Scene& scene) {
  std::vector<std::vector<std::uint32_t>> indices(model.meshes.size());
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    const tinygltf::Mesh& source = model.meshes[i];
    for (std::size_t p = 0; p < source.primitives.size(); ++p) {
      const tinygltf::Primitive& primitive = source.primitives[p];
      const std::string name = partName("mesh", i, source.name) + " primitive " + std::to_string(p);
      if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        throw SceneError(name + ": there is no mode " + std::to_string(primitive.mode));
      }
      if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        scene.warnings.push_back(name + ": points and lines are not supported; left out");
        continue;
      }
      indices[i].push_back(static_cast<std::uint32_t>(scene.meshes.size()));
      scene.meshes.push_back(convertPrimitive(model, primitive, name, scene));
    }
  }
  return indices;
}

}  // namespace walr::render::gltf
