#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace walr::reference {

/// Octahedral map of a unit vector, pole on +Z, remapped to [0, 1] (Cigolle et al. 2014; Meunier & Harada 2022, 5.2).
glm::dvec2 octahedralEncode(glm::dvec3 direction);
/// Its inverse; unit.
glm::dvec3 octahedralDecode(glm::dvec2 uv);
/// The two 16-bit unorms next to a direction's map, of which the second is never 0 (surface.glsl), and the direction
/// that they mean.
glm::dvec2 roundToUnorms(glm::dvec2 encoded);
glm::dvec3 roundToNormal(glm::dvec3 direction);
/// The short normal next to a direction (surface.glsl).
glm::dvec3 roundToShortNormal(glm::dvec3 direction);

}  // namespace walr::reference
