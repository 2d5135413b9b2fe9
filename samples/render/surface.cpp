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

// A point of a mesh where its material is evaluated.
struct MeshPoint {
  const Scene& scene;
  const Mesh& mesh;
  const glm::uvec3& triangle;
  const glm::vec2& weights;

  [[nodiscard]] glm::vec4 color() const {
    return mesh.colors.empty() ? glm::vec4(1.0F) : interpolate(mesh.colors, triangle, weights);
  }

  [[nodiscard]] glm::vec4 sample(std::uint32_t index, ColorSpace space) const {
    const Texture& texture = scene.textures[index];
    const auto first = texture.coordinates * static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec2 uv = mesh.uvs.empty() ? glm::vec2(0.0F) : interpolate(mesh.uvs, triangle + first, weights);
    return sampleTexture(scene.images[texture.image], texture, uv, space);
  }
};

void evaluateMaterial(const MeshPoint& point, const Material& material, Surface& surface) {
  glm::vec3 color = material.baseColor * glm::vec3(point.color());
  if (material.baseColorTexture) {
    color *= glm::vec3(point.sample(*material.baseColorTexture, ColorSpace::Srgb));
  }
  surface.metallic = material.metallic;
  surface.roughness = material.roughness;
  if (material.metallicRoughnessTexture) {
    const glm::vec4 texel = point.sample(*material.metallicRoughnessTexture, ColorSpace::Linear);
    surface.roughness *= texel.y;
    surface.metallic *= texel.z;
  }
  surface.albedo = color * (1.0F - surface.metallic);
  surface.reflectance = color;
}

// Interpolated normal with the normal map applied, on the front side of the triangle.
glm::vec3 mappedNormal(const MeshPoint& point, const Instance& instance, const glm::vec3& frontNormal) {
  const Mesh& mesh = point.mesh;
  if (mesh.normals.empty()) {
    return frontNormal;
  }
  const float side = instance.mirrored ? -1.0F : 1.0F;
  const glm::vec3 inObject = interpolate(mesh.normals, point.triangle, point.weights);
  const glm::vec3 normal =
      exact::unitOr(side * exact::transformDirection(instance.normalFromObject, inObject), frontNormal);
  if (mesh.tangents.empty()) {
    return normal;
  }
  const Material& material = point.scene.materials[mesh.material];
  const glm::vec4 tangent = interpolate(mesh.tangents, point.triangle, point.weights);
  const glm::vec3 worldTangent = exact::unitOr(
      exact::transformDirection(glm::mat3(instance.worldFromObject), glm::vec3(tangent)), glm::vec3(0.0F));
  const glm::vec3 encoded(point.sample(*material.normalTexture, ColorSpace::Linear));
  return exact::mapNormal(normal, worldTangent, tangent.w < 0.0F ? -side : side, encoded, material.normalScale);
}

}  // namespace

bool isHole(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric) {
  const Material& material = scene.materials[mesh.material];
  if (!material.alphaCutoff) {
    return false;
  }
  const MeshPoint point{scene, mesh, mesh.triangles[triangle], barycentric};
  float alpha = material.baseAlpha * point.color().w;
  if (material.baseColorTexture) {
    alpha *= point.sample(*material.baseColorTexture, ColorSpace::Linear).w;
  }
  return alpha < *material.alphaCutoff;
}

glm::vec3 emittedRadiance(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric) {
  const Material& material = scene.materials[mesh.material];
  if (!material.emissiveTexture) {
    return material.emission;
  }
  const MeshPoint point{scene, mesh, mesh.triangles[triangle], barycentric};
  return material.emission * glm::vec3(point.sample(*material.emissiveTexture, ColorSpace::Srgb));
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
  surface.previousPosition = isDisplaced(instance)
                                 ? glm::vec3(instance.previousWorldFromObject *
                                             glm::vec4(interpolate(mesh.positions, triangle, weights), 1.0F))
                                 : surface.position;
  surface.rayOffset = extent * kRelativeRayOffset;

  const float winding = instance.mirrored ? -1.0F : 1.0F;
  const glm::vec3 frontNormal = exact::frontNormal(corners[0], corners[1], corners[2], winding, -ray.direction);
  const bool front = exact::exactDot(frontNormal, ray.direction) <= 0.0F;
  const MeshPoint point{scene, mesh, triangle, weights};
  const glm::vec3 shading = mappedNormal(point, instance, frontNormal);
  surface.geometricNormal = front ? frontNormal : -frontNormal;
  surface.shadingNormal = exact::facing(front ? shading : -shading, ray.direction, surface.geometricNormal);
  surface.towardsViewer = -ray.direction;
  evaluateMaterial(point, material, surface);
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
