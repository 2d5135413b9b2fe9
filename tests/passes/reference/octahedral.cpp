#include "tests/passes/reference/octahedral.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace walr::reference {
namespace {

/// Mirror a point of the octahedron's far side across the near side's border, or back: the map is its own inverse.
glm::dvec2 fold(glm::dvec2 e) {
  return {(1.0 - std::abs(e.y)) * (e.x < 0.0 ? -1.0 : 1.0), (1.0 - std::abs(e.x)) * (e.y < 0.0 ? -1.0 : 1.0)};
}

}  // namespace

glm::dvec2 octahedralEncode(glm::dvec3 direction) {
  const glm::dvec3 onOctahedron = direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
  const glm::dvec2 near(onOctahedron);
  return (onOctahedron.z < 0.0 ? fold(near) : near) * 0.5 + 0.5;
}

glm::dvec3 octahedralDecode(glm::dvec2 uv) {
  const glm::dvec2 e = uv * 2.0 - 1.0;
  const double z = 1.0 - std::abs(e.x) - std::abs(e.y);
  return glm::normalize(glm::dvec3(z < 0.0 ? fold(e) : e, z));
}

}  // namespace walr::reference
