#pragma once

#include <glm/mat4x4.hpp>

namespace walr {

/// Orthographic cameras.
///
/// The passes know perspective cameras only: positions are view depth times a ray, and tolerances are relative to view
/// depth. An orthographic camera is therefore replaced by a perspective one, its stand-in, on the same axis and behind
/// it by the stand-off. Both show the same image of the plane through the orthographic camera. The host's motion
/// decides where history lies, so that reprojection is exact. Edge-stopping is that of a telephoto lens: the stand-in's
/// rays are at most 11 degrees off the axis, up or down, and its view depths are larger by the stand-off.

/// Whether a projection is orthographic: clip.w = 1.
bool isOrthographic(const glm::mat4& projection);

/// Distance from the stand-in to the orthographic camera, scene units: the power of two that is 2.5 to 5 times the
/// height of the image. It is a power of two so that it stays constant through most zooms: a change of it restarts the
/// history.
double standOff(const glm::mat4& projection);

/// The projection of the stand-in. Its z row is not set.
/// @param projection of an orthographic camera
glm::dmat4 standInProjection(const glm::mat4& projection);

/// World to view space of the stand-in.
glm::dmat4 standInView(const glm::mat4& view, const glm::mat4& projection);

}  // namespace walr
