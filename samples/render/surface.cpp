#include "samples/render/surface.h"

#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/exact/path.h"

namespace walr::render {
namespace {

template <typename T>
T interpolate(const std::vector<T>& values, const glm::uvec3& triangle, const glm::vec2& barycentric) {
  return exact::interpolate(values[triangle.x], values[triangle.y], values[triangle.z], barycentric);
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

// Interpolated normal with the normal map applied, on the front side of the triangle.
glm::vec3 mappedNormal(const Scene& scene, const Instance& instance, const glm::uvec3& triangle,
                       const glm::vec2& weights, const glm::vec2& uv, const glm::vec3& frontNormal) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  if (mesh.normals.empty()) {
    return frontNormal;
  }
  const float side = instance.mirrored ? -1.0F : 1.0F;
  const glm::vec3 inObject = interpolate(mesh.normals, triangle, weights);
  const glm::vec3 normal =
      exact::unitOr(side * exact::transformDirection(instance.normalFromObject, inObject), frontNormal);
  if (mesh.tangents.empty()) {
    return normal;
  }
  const Material& material = scene.materials[mesh.material];
  const glm::vec4 tangent = interpolate(mesh.tangents, triangle, weights);
  const glm::vec3 worldTangent = exact::unitOr(
      exact::transformDirection(glm::mat3(instance.worldFromObject), glm::vec3(tangent)), glm::vec3(0.0F));
  const glm::vec3 encoded(sample(scene, *material.normalTexture, uv, ColorSpace::Linear));
  return exact::mapNormal(normal, worldTangent, tangent.w < 0.0F ? -side : side, encoded, material.normalScale);
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

Surface evaluateSurface(const Scene& scene, const Instance& instance, const Hit& hit, const Ray& ray) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Material& material = scene.materials[mesh.material];
  const glm::uvec3& triangle = mesh.triangles[hit.triangle];
  std::array<glm::vec3, 3> corners{};
  float extent = 0.0F;
  for (glm::length_t i = 0; i < 3; ++i) {
    glm::vec3& corner = corners[static_cast<std::size_t>(i)];
    corner = exact::transformPoint(instance.worldFromObject, mesh.positions[triangle[i]]);
    const glm::vec3 size = glm::abs(corner);
    extent = glm::max(extent, glm::max(size.x, glm::max(size.y, size.z)));
  }

  Surface surface;
  const glm::vec2 weights = exact::weightsOfHit(ray.origin, ray.direction, corners[0], corners[1], corners[2]);
  surface.position = exact::interpolate(corners[0], corners[1], corners[2], weights);
  surface.previousPosition = instance.moves ? glm::vec3(instance.previousWorldFromObject *
                                                        glm::vec4(interpolate(mesh.positions, triangle, weights), 1.0F))
                                            : surface.position;
  // 2^-18: 64 times the relative rounding error (2^-24) of the corners' coordinates.
  constexpr float kRelativeOffset = 1.0F / 262144.0F;
  surface.rayOffset = extent * kRelativeOffset;

  const float winding = instance.mirrored ? -1.0F : 1.0F;
  const glm::vec3 frontNormal = exact::frontNormal(corners[0], corners[1], corners[2], winding, -ray.direction);
  const bool front = exact::exactDot(frontNormal, ray.direction) <= 0.0F;
  const glm::vec2 uv = textureCoordinate(mesh, hit.triangle, weights);
  const glm::vec3 shading = mappedNormal(scene, instance, triangle, weights, uv, frontNormal);
  surface.geometricNormal = front ? frontNormal : -frontNormal;
  surface.shadingNormal = exact::facing(front ? shading : -shading, ray.direction, surface.geometricNormal);
  surface.towardsViewer = -ray.direction;
  evaluateMaterial(scene, material, uv, surface);
  if (material.emits() && (front || material.doubleSided)) {
    surface.emission = emittedRadiance(scene, mesh, hit.triangle, weights);
  }
  return surface;
}

glm::vec3 rayOrigin(const Surface& surface, const glm::vec3& direction) {
  const float side = glm::dot(surface.geometricNormal, direction) < 0.0F ? -1.0F : 1.0F;
  return exact::offsetAlong(surface.position, surface.geometricNormal, side * surface.rayOffset);
}

}  // namespace walr::render
