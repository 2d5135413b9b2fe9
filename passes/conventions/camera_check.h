#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace walr {

/// Refuse a matrix that is not the projection of a camera in the project's conventions: clip.w = -view.z, or 1 for an
/// orthographic camera, y up, axes of the image parallel to those of view space. Row z, which holds depth, may be
/// anything.
/// @param orthographic whether the camera is stated to be orthographic
/// @throws std::invalid_argument naming the most likely cause: transposed, left-handed, y down, inverted, sheared, or
///         of the other kind than stated
void checkProjection(const glm::mat4& projection, bool orthographic = false);

/// Refuse a matrix that is not a rotation and a translation.
/// @throws std::invalid_argument naming the most likely cause: transposed, mirrored (left-handed), scaled, sheared
void checkView(const glm::mat4& view);

/// Whether two view matrices are the same but for the rounding errors of two ways to compute one matrix.
bool sameView(const glm::mat4& a, const glm::mat4& b);

/// Refuse an origin that is not finite, or so far away that doubles do not hold it to the precision that floats have
/// near the camera.
/// @throws std::invalid_argument
void checkOrigin(const glm::dvec3& origin);

}  // namespace walr
