#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

/// The specular lobe of glTF 2.0, appendix B, in double precision and as the specification writes it.
namespace walr::render::test {

/// Smith's Lambda of a cosine.
inline double smith(double cosine, double alpha2) {
  return (std::sqrt(1.0 + alpha2 * (1.0 - cosine * cosine) / (cosine * cosine)) - 1.0) / 2.0;
}

inline double schlick(double reflectance, double cosine) {
  return reflectance + (1.0 - reflectance) * std::pow(1.0 - cosine, 5.0);
}

/// BRDF without its Fresnel term, of unit vectors above the surface.
inline double ggx(const glm::dvec3& normal, const glm::dvec3& viewer, const glm::dvec3& light, double roughness) {
  const double alpha2 = std::pow(roughness, 4.0);
  const double facet = glm::dot(normal, glm::normalize(viewer + light));
  const double d = facet * facet * (alpha2 - 1.0) + 1.0;
  const double toViewer = glm::dot(normal, viewer);
  const double toLight = glm::dot(normal, light);
  return alpha2 / (std::numbers::pi * d * d) / (1.0 + smith(toViewer, alpha2) + smith(toLight, alpha2)) /
         (4.0 * toViewer * toLight);
}

/// The light that the lobe reflects under a sky of radiance 1, by the midpoint rule over facets. Rows take
/// ever smaller parts of the surface, because at grazing angles the few steep facets reflect most.
inline double directionalAlbedo(double cosine, double roughness, double reflectance, int steps = 100) {
  const double alpha2 = std::pow(roughness, 4.0);
  const glm::dvec3 viewer(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double left = 1.0 - (i + 0.5) / steps;  // Its cube is the share of facets that are steeper.
    const double z = 1.0 / std::sqrt(1.0 + alpha2 * (1.0 / (left * left * left) - 1.0));
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    for (int j = 0; j < steps; ++j) {
      const double angle = std::numbers::pi * (j + 0.5) / steps;  // The other half is the same.
      const glm::dvec3 facet(radius * std::cos(angle), radius * std::sin(angle), z);
      const double seen = glm::dot(viewer, facet);
      const double light = 2.0 * seen * z - cosine;
      if (seen <= 0.0 || light <= 0.0) continue;
      const double masking = 1.0 / (1.0 + smith(cosine, alpha2) + smith(light, alpha2));
      sum += 3.0 * left * left * schlick(reflectance, seen) * masking * seen / (cosine * z);
    }
  }
  return sum / (steps * steps);
}

}  // namespace walr::render::test
