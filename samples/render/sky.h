#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// A sampled direction towards the sky.
struct SkySample {
  glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< Unit.
  glm::vec3 radiance{0.0F};
  float density = 0.0F;  ///< Probability density per solid angle.
};

/// The light that arrives where rays hit nothing: a constant, or a map. Bright parts of a map are importance-sampled; a
/// constant does not need it, because cosine-distributed directions sample it best.
class Sky {
 public:
  /// @param scene  must outlive the sky
  explicit Sky(const Scene& scene);

  /// Radiance from a unit direction. Maps are interpolated bilinearly.
  [[nodiscard]] glm::vec3 radiance(const glm::vec3& direction) const;
  /// Whether `sample` may be called: there is a map that is not black.
  [[nodiscard]] bool isSampled() const { return !rows_.empty(); }
  /// The cumulative probabilities that `sample` inverts: of rows, and of columns within each row. Empty unless
  /// `isSampled`.
  [[nodiscard]] const std::vector<float>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<float>& columns() const { return columns_; }
  /// Sample a direction; texels are chosen in proportion to their light (Pharr et al. 2016, 14.2.4).
  /// @param random  uniform in the unit square
  [[nodiscard]] SkySample sample(const glm::vec2& random) const;
  /// Probability density per solid angle of `sample` for a direction; 0 unless `isSampled`.
  [[nodiscard]] float density(const glm::vec3& direction) const;

 private:
  const Scene& scene_;
  std::vector<float> rows_;     // Cumulative probability of rows.
  std::vector<float> columns_;  // Cumulative probability of columns within each row.
};

}  // namespace walr::render
