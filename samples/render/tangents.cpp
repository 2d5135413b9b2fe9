#include "samples/render/tangents.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace walr::render {
namespace {

// The kinds of triangles: those that show the texture as it is, and those that show it mirrored.
constexpr std::size_t kKinds = 2;
constexpr std::array<float, kKinds> kHandedness = {1.0F, -1.0F};

struct TriangleTangent {
  glm::vec3 direction{0.0F};  // Of increasing u, unit.
  std::size_t kind = 0;
};

// Nothing if the triangle has no area in the texture.
std::optional<TriangleTangent> triangleTangent(const Mesh& mesh, std::span<const glm::vec2> uvs,
                                               const glm::uvec3& triangle) {
  const glm::vec3 edge1 = mesh.positions[triangle.y] - mesh.positions[triangle.x];
  const glm::vec3 edge2 = mesh.positions[triangle.z] - mesh.positions[triangle.x];
  const glm::vec2 uv1 = uvs[triangle.y] - uvs[triangle.x];
  const glm::vec2 uv2 = uvs[triangle.z] - uvs[triangle.x];
  const float determinant = uv1.x * uv2.y - uv1.y * uv2.x;
  const glm::vec3 scaled = (edge1 * uv2.y - edge2 * uv1.y) * (determinant < 0.0F ? -1.0F : 1.0F);
  const float length = glm::length(scaled);
  if (determinant == 0.0F || !(length > 0.0F) || !std::isfinite(length)) {
    return std::nullopt;
  }
  // A negative one is not mirrored, because glTF's v points down in the image and the bitangent of a normal map up.
  return TriangleTangent{scaled / length, determinant < 0.0F ? 0U : 1U};
}

glm::vec3 perpendicularTo(const glm::vec3& normal, const glm::vec3& v) {
  return v - normal * glm::dot(normal, v);
}

glm::vec3 unitOrZero(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0F && std::isfinite(length) ? v / length : glm::vec3(0.0F);
}

float angleBetween(const glm::vec3& a, const glm::vec3& b) {
  return std::acos(glm::clamp(glm::dot(unitOrZero(a), unitOrZero(b)), -1.0F, 1.0F));
}

// What a vertex has of one kind of triangles.
struct VertexTangent {
  glm::vec3 sum{0.0F};  // Of the triangles' directions, weighted by angles.
  bool used = false;
};
using VertexTangents = std::array<VertexTangent, kKinds>;

template <typename T>
void appendCopies(std::vector<T>& values, std::span<const std::uint32_t> vertices) {
  if (values.empty()) return;
  values.reserve(values.size() + vertices.size());
  for (const std::uint32_t vertex : vertices) values.push_back(values[vertex]);
}

// Appends copies of vertices to the mesh. Its triangles stay as they are.
void duplicate(Mesh& mesh, std::span<const std::uint32_t> vertices) {
  std::vector<glm::vec2> uvs;
  uvs.reserve(mesh.uvs.size() + mesh.uvs.size() / mesh.positions.size() * vertices.size());
  for (std::size_t first = 0; first < mesh.uvs.size(); first += mesh.positions.size()) {
    const std::span<const glm::vec2> set = std::span(mesh.uvs).subspan(first, mesh.positions.size());
    uvs.insert(uvs.end(), set.begin(), set.end());
    for (const std::uint32_t vertex : vertices) uvs.push_back(set[vertex]);
  }
  mesh.uvs = std::move(uvs);
  appendCopies(mesh.positions, vertices);
  appendCopies(mesh.normals, vertices);
  appendCopies(mesh.colors, vertices);
}

}  // namespace

void deriveTangents(Mesh& mesh, std::size_t set) {
  const std::size_t given = mesh.positions.size();
  const std::span<const glm::vec2> uvs = std::span(mesh.uvs).subspan(set * given, given);
  std::vector<VertexTangents> vertices(given);
  std::vector<std::optional<std::size_t>> kinds;  // Of the triangles.
  kinds.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    const std::optional<TriangleTangent> tangent = triangleTangent(mesh, uvs, triangle);
    kinds.push_back(tangent ? std::optional(tangent->kind) : std::nullopt);
    if (!tangent) continue;
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = triangle[corner];
      const glm::vec3& normal = mesh.normals[vertex];
      const glm::vec3& position = mesh.positions[vertex];
      const float angle = angleBetween(perpendicularTo(normal, mesh.positions[triangle[(corner + 1) % 3]] - position),
                                       perpendicularTo(normal, mesh.positions[triangle[(corner + 2) % 3]] - position));
      VertexTangent& own = vertices[vertex][tangent->kind];
      own.sum += angle * unitOrZero(perpendicularTo(normal, tangent->direction));
      own.used = true;
    }
  }

  // Between the kinds, the bitangent turns over: an interpolated one would be wrong on one side. A shared vertex keeps
  // the first kind, and its copy has the second.
  std::vector<std::uint32_t> shared;
  std::vector<std::uint32_t> ofSecond(given);
  mesh.tangents.reserve(given);
  for (std::uint32_t vertex = 0; vertex < given; ++vertex) {
    const auto& [first, second] = vertices[vertex];
    ofSecond[vertex] = vertex;
    if (first.used && second.used) {
      ofSecond[vertex] = static_cast<std::uint32_t>(given + shared.size());
      shared.push_back(vertex);
    }
    const std::size_t kind = first.used || !second.used ? 0 : 1;
    mesh.tangents.emplace_back(unitOrZero(vertices[vertex][kind].sum), kHandedness[kind]);
  }
  for (const std::uint32_t vertex : shared) {
    mesh.tangents.emplace_back(unitOrZero(vertices[vertex][1].sum), kHandedness[1]);
  }
  duplicate(mesh, shared);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] != std::optional<std::size_t>(1)) continue;
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      mesh.triangles[i][corner] = ofSecond[mesh.triangles[i][corner]];
    }
  }
}

}  // namespace walr::render
