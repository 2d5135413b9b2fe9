#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace walr::reference {

/// Octahedral map of a unit vector, pole on +Z, remapped to [0, 1] (Cigolle et al. 2014; Meunier & Harada 2022, 5.2).
glm::dvec2 octahedralEncode(glm::dvec3 direction);
/// The inverse of the map; a unit vector.
glm::dvec3 octahedralDecode(glm::dvec2 uv);
/// The two 16-bit unorms nearest to an octahedral map (surface.glsl).
glm::dvec2 roundToUnorms(glm::dvec2 encoded);
/// The direction that these unorms decode to.
glm::dvec3 roundToNormal(glm::dvec3 direction);
/// Stereographic projection of a unit vector that is not -Z, and its inverse.
glm::dvec2 stereographicEncode(glm::dvec3 direction);
glm::dvec3 stereographicDecode(glm::dvec2 point);
/// The direction that the nearest short normal decodes to (surface.glsl).
glm::dvec3 roundToShortNormal(glm::dvec3 direction);

}  // namespace walr::reference
