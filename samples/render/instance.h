#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// A mesh with its world transform in this frame and in the previous one.
struct Instance {
  std::uint32_t mesh = 0;  ///< Index into `Scene::meshes`.
  std::uint32_t node = 0;  ///< Index into `Scene::nodes`.
  bool moves = false;      ///< The node or one of its ancestors is animated.
  glm::mat4 worldFromObject{1.0F};
  glm::mat4 previousWorldFromObject{1.0F};
  glm::mat3 normalFromObject{1.0F};  ///< Cofactor matrix: keeps normals perpendicular under any scale.
  bool mirrored = false;             ///< The transform reverses the winding of triangles.
};

/// Whether an instance is not where it was in the previous frame.
inline bool isDisplaced(const Instance& instance) {
  return instance.moves && instance.worldFromObject != instance.previousWorldFromObject;
}

/// The instances of all nodes of a scene, in the order of the nodes, at time 0.
std::vector<Instance> makeInstances(const Scene& scene);

/// Update instances with the nodes' world transforms (see `worldTransforms`) in this frame and in the previous one.
/// @throws SceneError naming a node whose transform is not finite or too large
void placeInstances(const Scene& scene, const std::vector<glm::mat4>& current, const std::vector<glm::mat4>& previous,
                    std::vector<Instance>& instances);

}  // namespace walr::render
