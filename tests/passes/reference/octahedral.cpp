#include "tests/passes/reference/octahedral.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/passes/reference/storage.h"

namespace walr::reference {
namespace {

/// Map a point between the octahedron's far and near side (Cigolle et al. 2014); the map is its own inverse.
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

glm::dvec2 roundToUnorms(glm::dvec2 encoded) {
  return {roundToUnorm16(encoded.x), roundToUnorm16(encoded.y)};
}

glm::dvec3 roundToNormal(glm::dvec3 direction) {
  return octahedralDecode(roundToUnorms(octahedralEncode(direction)));
}

glm::dvec2 stereographicEncode(glm::dvec3 direction) {
  return glm::dvec2(direction) / (1.0 + direction.z);
}

glm::dvec3 stereographicDecode(glm::dvec2 point) {
  const double squared = glm::dot(point, point);
  return glm::dvec3(2.0 * point, 1.0 - squared) / (1.0 + squared);
}

glm::dvec3 roundToShortNormal(glm::dvec3 direction) {
  const glm::dvec2 inside = glm::clamp(stereographicEncode(direction), -kShortNormalEnd, kShortNormalEnd);
  return stereographicDecode(kShortNormalStep * glm::round(inside / kShortNormalStep));
}

}  // namespace walr::reference
