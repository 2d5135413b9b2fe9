#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// A direction towards the sky.
struct SkySample {
  glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< Unit.
  glm::vec3 radiance{0.0F};
  float density = 0.0F;  ///< Probability density per solid angle.
};

/// What lies behind everything: a constant, which cosine-distributed directions sample best, or a map, of which bright
/// parts are also sought out.
class Sky {
 public:
  /// @param scene  must outlive the sky
  explicit Sky(const Scene& scene);

  /// Radiance from a direction, unit. Maps are interpolated bilinearly.
  [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const;
  /// Whether `sample` is of use: there is a map, and light in it.
  [[nodiscard]] bool isSampled() const { return !rows_.empty(); }
  /// A direction, texels chosen in proportion to the light within them (Pharr et al. 2016, 14.2.4).
  /// @param random  uniform in the unit square
  [[nodiscard]] SkySample sample(const glm::vec2& random) const;
  /// Density per solid angle with which `sample` takes a direction; 0 unless `isSampled`.
  [[nodiscard]] float density(const glm::vec3& direction) const;

 private:
  const Scene& scene_;
  std::vector<float> rows_;     // Cumulative probability of rows.
  std::vector<float> columns_;  // Cumulative probability of columns within each row.
};

}  // namespace walr::render
