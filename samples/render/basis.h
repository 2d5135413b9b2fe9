#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace walr::render {

/// Transform a direction from the local frame of a unit normal, where the normal is +Z, to the normal's space (Duff et
/// al. 2017).
inline glm::vec3 fromLocal(const glm::vec3& normal, const glm::vec3& local) {
  const float sign = std::copysign(1.0F, normal.z);
  const float a = -1.0F / (sign + normal.z);
  const float b = normal.x * normal.y * a;
  const glm::vec3 tangent(1.0F + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
  const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
  return tangent * local.x + bitangent * local.y + normal * local.z;
}

}  // namespace walr::render
