#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// A mesh at its place in the world, now and one frame ago.
struct Instance {
  std::uint32_t mesh = 0;  ///< Index into `Scene::meshes`.
  std::uint32_t node = 0;  ///< Index into `Scene::nodes`.
  bool moves = false;      ///< The node or one above it is animated.
  glm::mat4 worldFromObject{1.0F};
  glm::mat4 previousWorldFromObject{1.0F};
  glm::mat3 normalFromObject{1.0F};  ///< Cofactor matrix: keeps normals perpendicular, whatever the scale.
  bool mirrored = false;             ///< The transform turns the winding of triangles around.
};

/// All instances of a scene's nodes in the order of the nodes, placed at time 0.
std::vector<Instance> makeInstances(const Scene& scene);

/// Place instances by the world transforms of the scene's nodes (see `worldTransforms`) of this frame and the previous.
/// @throws SceneError naming a node whose transform is not finite
void placeInstances(const Scene& scene, const std::vector<glm::mat4>& current, const std::vector<glm::mat4>& previous,
                    std::vector<Instance>& instances);

}  // namespace walr::render
