#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/instance.h"
#include "samples/render/ray_caster.h"
#include "samples/render/scene.h"

namespace walr::render {

/// `Surface::rayOffset` relative to the largest coordinate of the triangle's corners: 2^-18, 64 times their relative
/// rounding error (2^-24).
inline constexpr float kRelativeRayOffset = 1.0F / 262144.0F;

/// A surface point in world space, seen from one side.
struct Surface {
  glm::vec3 position{0.0F};
  glm::vec3 previousPosition{0.0F};  ///< Where this point of the object was one frame ago.
  glm::vec3 geometricNormal{0.0F};   ///< Normal of the triangle, unit, towards the viewer.
  /// Interpolated and normal-mapped, unit, on the geometric normal's side. A normal that would point away from the
  /// viewer is bent until it is perpendicular to the view direction.
  glm::vec3 shadingNormal{0.0F};
  glm::vec3 albedo{0.0F};  ///< Diffuse albedo, 0..1; 0 on metals.
  float roughness = 1.0F;
  float metallic = 0.0F;          ///< 0..1
  glm::vec3 reflectance{0.0F};    ///< Reflectance of the metal at normal incidence.
  glm::vec3 towardsViewer{0.0F};  ///< Unit.
  glm::vec3 emission{0.0F};       ///< Radiance towards the viewer.
  float rayOffset = 0.0F;  ///< Distance along the geometric normal that exceeds the rounding error of `position`.
};

/// The surface where a ray hit a triangle.
/// @param ray  its direction is unit
Surface evaluateSurface(const Scene& scene, const Instance& instance, const Hit& hit, const Ray& ray);

/// The origin of a ray that leaves a surface in `direction`, offset so that it does not hit the surface itself.
glm::vec3 rayOrigin(const Surface& surface, const glm::vec3& direction);

/// Radiance that a triangle emits at a point to its front, and also to its back if the material is double-sided.
glm::vec3 emittedRadiance(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric);

/// Whether a cut-out (`Material::alphaCutoff`) has a hole at a point of a triangle.
bool isHole(const Scene& scene, const Mesh& mesh, std::uint32_t triangle, const glm::vec2& barycentric);

}  // namespace walr::render
