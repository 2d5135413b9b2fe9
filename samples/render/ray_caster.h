#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "samples/render/instance.h"
#include "samples/render/scene.h"

namespace walr::render {

/// A ray, or a segment of it.
struct Ray {
  glm::vec3 origin{0.0F};
  glm::vec3 direction{0.0F, 0.0F, -1.0F};                 ///< Any length but 0.
  float length = std::numeric_limits<float>::infinity();  ///< In units of the length of `direction`.
};

/// The triangle that a ray hit. `evaluateSurface` finds the point.
struct Hit {
  std::uint32_t instance = 0;  ///< Index into the instances that the ray caster was constructed with.
  std::uint32_t triangle = 0;  ///< Index into `Mesh::triangles`.
};

/// Intersects rays with the scene's instances, using Embree. Rays pass through the holes of cut-outs
/// (`Material::alphaCutoff`). All still instances share one acceleration structure in world space, so that overlapping
/// large meshes cost nothing extra. Each moving instance is an instance of its own in a top-level structure.
class RayCaster {
 public:
  /// @param scene      must outlive the ray caster
  /// @param instances  with their current transforms; those of still instances are final
  /// @throws std::runtime_error with Embree's error code
  RayCaster(const Scene& scene, const std::vector<Instance>& instances);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;
  RayCaster(RayCaster&&) = delete;
  RayCaster& operator=(RayCaster&&) = delete;

  /// Update the transforms of the moving instances. Must not be called while rays are traced.
  void update(const std::vector<Instance>& instances);

  /// The nearest triangle along a ray. Safe to call from many threads.
  [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const;

  /// Whether a ray hits anything. Safe to call from many threads.
  [[nodiscard]] bool occluded(const Ray& ray) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace walr::render
