#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/instance.h"
#include "samples/render/scene.h"

namespace walr::render {

/// A half-line, or a part of it.
struct Ray {
  glm::vec3 origin{0.0F};
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< Distances count in its length.
  float length = std::numeric_limits<float>::infinity();
};

/// Where a ray met a triangle.
struct Hit {
  std::uint32_t instance = 0;   ///< Index into the instances the ray caster was made with.
  std::uint32_t triangle = 0;   ///< Index into `Mesh::triangles`.
  glm::vec2 barycentric{0.0F};  ///< Weights of the triangle's second and third vertex.
};

/// Finds what rays meet: Embree over the scene's instances, cut-outs (`Material::alphaCutoff`) seen through. What
/// does not move is one acceleration structure in world space, so that large meshes lying over one another cost
/// nothing extra; what moves is instanced over it.
class RayCaster {
 public:
  /// @param scene      must outlive the ray caster
  /// @param instances  placed; still ones stay where they are now
  /// @throws std::runtime_error naming Embree's complaint
  RayCaster(const Scene& scene, const std::vector<Instance>& instances);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;
  RayCaster(RayCaster&&) = delete;
  RayCaster& operator=(RayCaster&&) = delete;

  /// Take over the places of the moving instances. Not while rays are traced.
  void update(const std::vector<Instance>& instances);

  /// The first triangle along a ray. Safe to call from many threads.
  [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const;

  /// Whether anything lies along a ray. Safe to call from many threads.
  [[nodiscard]] bool occluded(const Ray& ray) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace walr::render
