#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "samples/render/animation.h"
#include "samples/render/instance.h"
#include "samples/render/lights.h"
#include "samples/render/ray_caster.h"
#include "samples/render/scene.h"
#include "samples/render/sky.h"

namespace walr::render {

/// What casts rays in a world.
enum class RayCasting : std::uint8_t {
  Embree,
  None,  ///< Nothing on the processor: a path tracer on a GPU has its own copy of the scene.
};

/// A scene at one time of its animation, ready to be traced.
class World {
 public:
  /// Starts at time 0. @param scene must outlive the world
  explicit World(const Scene& scene, RayCasting rayCasting = RayCasting::Embree);

  /// Set the time. @param seconds, previousSeconds  times of this frame and of the frame before it
  void moveTo(double seconds, double previousSeconds);

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }
  /// Only with `RayCasting::Embree`.
  [[nodiscard]] const RayCaster& rays() const { return *rays_; }
  [[nodiscard]] const Lights& lights() const { return lights_; }
  [[nodiscard]] const Sky& sky() const { return sky_; }
  /// World transforms of the scene's nodes in this frame and in the previous one.
  [[nodiscard]] const std::vector<glm::mat4>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<glm::mat4>& previousNodes() const { return previousNodes_; }

 private:
  const Scene& scene_;
  std::vector<glm::mat4> nodes_;
  std::vector<glm::mat4> previousNodes_;
  std::vector<Instance> instances_;
  std::optional<RayCaster> rays_;  // Nothing with `RayCasting::None`.
  Lights lights_;
  Sky sky_;
};

}  // namespace walr::render
