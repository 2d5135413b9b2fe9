#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/instance.h"
#include "samples/render/scene.h"

namespace walr::render {

/// A punctual light in world space.
struct PlacedLight {
  PunctualLight light;
  glm::vec3 position{0.0F};
  glm::vec3 axis{0.0F, 0.0F, -1.0F};  ///< Direction in which it shines, unit.
};

/// The light that a punctual light sends to a point.
struct Illumination {
  glm::vec3 towardsLight{0.0F};  ///< Unit.
  float distance = 0.0F;         ///< Infinite for a directional light.
  glm::vec3 irradiance{0.0F};    ///< On a plane that faces the light, without occlusion.
};

/// A point on an emissive triangle.
struct EmitterSample {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F};    ///< Unit, front side.
  glm::vec3 radiance{0.0F};  ///< Emitted to the front, and to the back if `doubleSided`.
  bool doubleSided = false;
  float density = 0.0F;  ///< Probability density per area.
};

/// An emissive triangle.
struct Emitter {
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  std::array<glm::vec3, 3> corners{};  ///< In world space.
  float area = 0.0F;
  double cumulative = 0.0;  ///< Sum of the probabilities of this emitter and all before it.
  float probability = 0.0F;
};

/// The punctual lights and emissive triangles of a scene at one time. The sky is separate (see `Sky`).
class Lights {
 public:
  /// @param worldFromNode  see `worldTransforms`
  Lights(const Scene& scene, const std::vector<Instance>& instances, const std::vector<glm::mat4>& worldFromNode);

  [[nodiscard]] const std::vector<PlacedLight>& punctual() const { return punctual_; }
  [[nodiscard]] bool hasEmitters() const { return !emitters_.empty(); }
  [[nodiscard]] const std::vector<Emitter>& emitters() const { return emitters_; }
  /// For every instance that emits, the index of its first triangle in `emitters`, where its triangles are consecutive.
  [[nodiscard]] const std::vector<std::optional<std::uint32_t>>& firstEmitters() const { return firstEmitter_; }

  /// Sample a point on the emissive triangles. Triangles are chosen in proportion to area times emission.
  /// @param choice  uniform in [0, 1): picks the triangle
  /// @param point   uniform in the unit square: picks the point on it
  [[nodiscard]] EmitterSample sampleEmitters(const Scene& scene, const std::vector<Instance>& instances, float choice,
                                             const glm::vec2& point) const;

  /// Probability density per area of `sampleEmitters` for the points of a triangle; 0 if the triangle does not emit.
  [[nodiscard]] float emitterDensity(std::uint32_t instance, std::uint32_t triangle) const;

 private:
  std::vector<PlacedLight> punctual_;
  std::vector<Emitter> emitters_;
  std::vector<std::optional<std::uint32_t>> firstEmitter_;
};

/// The light that arrives at a point in world space, without occlusion.
Illumination illuminate(const PlacedLight& light, const glm::vec3& point);

}  // namespace walr::render
