#include "samples/render/surface.h"

#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace walr::render {
namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const glm::uvec3& triangle, const glm::vec2& barycentric) {
  return values[triangle.x] * (1.0F - barycentric.x - barycentric.y) + values[triangle.y] * barycentric.x +
         values[triangle.z] * barycentric.y;
}

glm::vec2 textureCoordinate(const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric) {
  return mesh.uvs.empty() ? glm::vec2(0.0F) : interpolate(mesh.uvs, mesh.triangles[triangle], barycentric);
}

glm::vec4 sample(const Scene& scene, std::uint32_t index, const glm::vec2& uv, ColorSpace space) {
  const Texture& texture = scene.textures[index];
  return sampleTexture(scene.images[texture.image], texture, uv, space);
}

void evaluateMaterial(const Scene& scene, const Material& material, const glm::vec2& uv, Surface& surface) {
  glm::vec3 color = material.baseColor;
  if (material.baseColorTexture) {
    color *= glm::vec3(sample(scene, *material.baseColorTexture, uv, ColorSpace::Srgb));
  }
  surface.metallic = material.metallic;
  surface.roughness = material.roughness;
  if (material.metallicRoughnessTexture) {
    const glm::vec4 texel = sample(scene, *material.metallicRoughnessTexture, uv, ColorSpace::Linear);
    surface.roughness *= texel.y;
    surface.metallic *= texel.z;
  }
  surface.albedo = color * (1.0F - surface.metallic);
  surface.reflectance = color;
}

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& fallback) {
  const float length = glm::length(v);
  return length > 0.0F && std::isfinite(length) ? v / length : fallback;
}

// Interpolated normal with the normal map applied (glTF 2.0, section 3.9.3), on the front side of the triangle.
glm::vec3 mappedNormal(const Scene& scene, const Instance& instance, const Hit& hit, const glm::vec2& uv,
                       const glm::vec3& frontNormal) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const glm::uvec3& triangle = mesh.triangles[hit.triangle];
  if (mesh.normals.empty()) {
    return frontNormal;
  }
  const float side = instance.mirrored ? -1.0F : 1.0F;
  const glm::vec3 normal =
      unitOr(side * (instance.normalFromObject * interpolate(mesh.normals, triangle, hit.barycentric)), frontNormal);
  if (mesh.tangents.empty()) {
    return normal;
  }
  const Material& material = scene.materials[mesh.material];
  const glm::vec4 tangent = interpolate(mesh.tangents, triangle, hit.barycentric);
  const glm::vec3 worldTangent = unitOr(glm::mat3(instance.worldFromObject) * glm::vec3(tangent), glm::vec3(0.0F));
  const glm::vec3 bitangent = glm::cross(normal, worldTangent) * (tangent.w < 0.0F ? -side : side);
  const glm::vec3 encoded(sample(scene, *material.normalTexture, uv, ColorSpace::Linear));
  const glm::vec3 local = (encoded * 2.0F - 1.0F) * glm::vec3(material.normalScale, material.normalScale, 1.0F);
  return unitOr(worldTangent * local.x + bitangent * local.y + normal * local.z, normal);
}

// Bends a normal that points away from the viewer until it is perpendicular to the view direction.
glm::vec3 facing(const glm::vec3& normal, const glm::vec3& viewDirection, const glm::vec3& geometricNormal) {
  const float away = glm::dot(normal, viewDirection);
  return away <= 0.0F ? normal : unitOr(normal - viewDirection * away, geometricNormal);
}

}  // namespace

bool isHole(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric) {
  const Material& material = scene.materials[mesh.material];
  if (!material.alphaCutoff) {
    return false;
  }
  float alpha = material.baseAlpha;
  if (material.baseColorTexture) {
    const glm::vec2 uv = textureCoordinate(mesh, triangle, barycentric);
    alpha *= sample(scene, *material.baseColorTexture, uv, ColorSpace::Linear).w;
  }
  return alpha < *material.alphaCutoff;
}

glm::vec3 emittedRadiance(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric) {
  const Material& material = scene.materials[mesh.material];
  if (!material.emissiveTexture) {
    return material.emission;
  }
  const glm::vec2 uv = textureCoordinate(mesh, triangle, barycentric);
  return material.emission * glm::vec3(sample(scene, *material.emissiveTexture, uv, ColorSpace::Srgb));
}

Surface evaluateSurface(const Scene& scene, const Instance& instance, const Hit& hit, const glm::vec3& viewDirection) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Material& material = scene.materials[mesh.material];
  const glm::uvec3& triangle = mesh.triangles[hit.triangle];
  std::array<glm::vec3, 3> corners{};
  float extent = 0.0F;
  for (glm::length_t i = 0; i < 3; ++i) {
    corners[static_cast<std::size_t>(i)] =
        glm::vec3(instance.worldFromObject * glm::vec4(mesh.positions[triangle[i]], 1.0F));
    const glm::vec3 size = glm::abs(corners[static_cast<std::size_t>(i)]);
    extent = glm::max(extent, glm::max(size.x, glm::max(size.y, size.z)));
  }

  Surface surface;
  const glm::vec2 weights = hit.barycentric;
  surface.position = corners[0] * (1.0F - weights.x - weights.y) + corners[1] * weights.x + corners[2] * weights.y;
  surface.previousPosition = instance.moves ? glm::vec3(instance.previousWorldFromObject *
                                                        glm::vec4(interpolate(mesh.positions, triangle, weights), 1.0F))
                                            : surface.position;
  // 2^-18: 64 times the relative rounding error (2^-24) of the corners' coordinates.
  constexpr float kRelativeOffset = 1.0F / 262144.0F;
  surface.rayOffset = extent * kRelativeOffset;

  const float winding = instance.mirrored ? -1.0F : 1.0F;
  const glm::vec3 frontNormal =
      winding * unitOr(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), -viewDirection);
  const bool front = glm::dot(frontNormal, viewDirection) <= 0.0F;
  const glm::vec2 uv = textureCoordinate(mesh, hit.triangle, weights);
  const glm::vec3 shading = mappedNormal(scene, instance, hit, uv, frontNormal);
  surface.geometricNormal = front ? frontNormal : -frontNormal;
  surface.shadingNormal = facing(front ? shading : -shading, viewDirection, surface.geometricNormal);
  surface.towardsViewer = -viewDirection;
  evaluateMaterial(scene, material, uv, surface);
  if (material.emits() && (front || material.doubleSided)) {
    surface.emission = emittedRadiance(scene, mesh, hit.triangle, weights);
  }
  return surface;
}

glm::vec3 rayOrigin(const Surface& surface, const glm::vec3& direction) {
  const float side = glm::dot(surface.geometricNormal, direction) < 0.0F ? -1.0F : 1.0F;
  return surface.position + surface.geometricNormal * (side * surface.rayOffset);
}

}  // namespace walr::render
