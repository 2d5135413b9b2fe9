#include "samples/render/tangents.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace walr::render {
namespace {

struct TriangleTangent {
  glm::vec3 direction{0.0F};  // Of increasing u, unit; zero if the triangle has no area in the texture.
  float handedness = 1.0F;
};

TriangleTangent triangleTangent(const Mesh& mesh, std::span<const glm::vec2> uvs, const glm::uvec3& triangle) {
  const glm::vec3 edge1 = mesh.positions[triangle.y] - mesh.positions[triangle.x];
  const glm::vec3 edge2 = mesh.positions[triangle.z] - mesh.positions[triangle.x];
  const glm::vec2 uv1 = uvs[triangle.y] - uvs[triangle.x];
  const glm::vec2 uv2 = uvs[triangle.z] - uvs[triangle.x];
  const float determinant = uv1.x * uv2.y - uv1.y * uv2.x;
  const glm::vec3 scaled = (edge1 * uv2.y - edge2 * uv1.y) * (determinant < 0.0F ? -1.0F : 1.0F);
  const float length = glm::length(scaled);
  if (determinant == 0.0F || !(length > 0.0F) || !std::isfinite(length)) {
    return {};
  }
  // The sign is negative because glTF's v points down in the image and the bitangent of a normal map points up.
  return {scaled / length, determinant < 0.0F ? 1.0F : -1.0F};
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

}  // namespace

std::vector<glm::vec4> deriveTangents(const Mesh& mesh, std::span<const glm::vec2> uvs) {
  std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0.0F));
  std::vector<float> handedness(mesh.positions.size(), 0.0F);
  for (const glm::uvec3& triangle : mesh.triangles) {
    const TriangleTangent tangent = triangleTangent(mesh, uvs, triangle);
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = triangle[corner];
      const glm::vec3& normal = mesh.normals[vertex];
      const glm::vec3& position = mesh.positions[vertex];
      const float angle = angleBetween(perpendicularTo(normal, mesh.positions[triangle[(corner + 1) % 3]] - position),
                                       perpendicularTo(normal, mesh.positions[triangle[(corner + 2) % 3]] - position));
      sums[vertex] += angle * unitOrZero(perpendicularTo(normal, tangent.direction));
      handedness[vertex] += angle * tangent.handedness;
    }
  }
  std::vector<glm::vec4> tangents;
  tangents.reserve(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    tangents.emplace_back(unitOrZero(sums[i]), handedness[i] < 0.0F ? -1.0F : 1.0F);
  }
  return tangents;
}

}  // namespace walr::render
