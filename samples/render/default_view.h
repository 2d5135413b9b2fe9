#pragma once

#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// An axis-aligned box in world space.
struct Box {
  glm::vec3 low{0.0F};
  glm::vec3 high{0.0F};
};

/// The box around all meshes of a scene.
/// @param worldFromNode  world transforms of the scene's nodes
Box boundingBox(const Scene& scene, std::span<const glm::mat4> worldFromNode);

/// Add a camera that frames the scene's bounding box at the start of its animation, in a three-quarter view from the
/// front and above. The whole box is seen in pictures that are at least as wide as high.
/// @throws SceneError if the camera would be farther from the origin than `kFarthestCamera`
void addFramingCamera(Scene& scene);

}  // namespace walr::render
