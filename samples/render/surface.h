#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/instance.h"
#include "samples/render/ray_caster.h"
#include "samples/render/scene.h"

namespace walr::render {

/// A point of a surface as seen from one side, in world space.
struct Surface {
  glm::vec3 position{0.0F};
  glm::vec3 previousPosition{0.0F};  ///< Where this point of the object was one frame ago.
  glm::vec3 geometricNormal{0.0F};   ///< Of the triangle, unit, towards the viewer.
  /// Interpolated and normal-mapped, unit, on the geometric normal's side; where it would point away from the viewer,
  /// it is bent to be perpendicular to the view direction.
  glm::vec3 shadingNormal{0.0F};
  glm::vec3 albedo{0.0F};  ///< Of the diffuse lobe: 0..1; 0 on metals.
  float roughness = 1.0F;
  float metallic = 0.0F;          ///< 0..1
  glm::vec3 reflectance{0.0F};    ///< Of the metal, seen along its normal.
  glm::vec3 towardsViewer{0.0F};  ///< Unit.
  glm::vec3 emission{0.0F};       ///< Radiance towards the viewer.
  float rayOffset = 0.0F;         ///< Distance along the geometric normal that clears the roundoff of `position`.
};

/// What a ray met.
/// @param viewDirection  the ray's direction, unit
Surface evaluateSurface(const Scene& scene, const Instance& instance, const Hit& hit, const glm::vec3& viewDirection);

/// The origin of a ray that leaves a surface to the side of `direction`.
glm::vec3 rayOrigin(const Surface& surface, const glm::vec3& direction);

/// Radiance that a triangle emits at a point to its front, or to its back where the material is double-sided.
glm::vec3 emittedRadiance(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric);

/// Whether a cut-out (`Material::alphaCutoff`) leaves a hole at a point of a triangle.
bool isHole(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric);

}  // namespace walr::render
