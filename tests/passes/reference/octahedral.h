#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace walr::reference {

/// Octahedral map of a unit vector, pole on +Z, remapped to [0, 1] (Cigolle et al. 2014; walr.txt 5.2).
glm::dvec2 octahedralEncode(glm::dvec3 direction);
/// Its inverse; unit.
glm::dvec3 octahedralDecode(glm::dvec2 uv);

}  // namespace walr::reference
