#include "samples/render/instance.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "samples/render/animation.h"
#include "samples/render/scene_error.h"

namespace walr::render {
namespace {

glm::mat3 cofactors(const glm::mat3& m) {
  return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// Whether positions of any mesh that the loader accepts, and squared distances between them, stay finite in float.
bool isUsable(const glm::mat4& m) {
  constexpr float kLargest = 1e6F;
  for (glm::length_t column = 0; column < 4; ++column) {
    for (glm::length_t row = 0; row < 4; ++row) {
      if (!(std::abs(m[column][row]) <= kLargest)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

std::vector<Instance> makeInstances(const Scene& scene) {
  const std::vector<bool> animated = animatedNodes(scene);
  std::vector<Instance> instances;
  for (std::uint32_t node = 0; node < scene.nodes.size(); ++node) {
    for (const std::uint32_t mesh : scene.nodes[node].meshes) {
      Instance instance;
      instance.mesh = mesh;
      instance.node = node;
      instance.moves = animated[node];
      instances.push_back(instance);
    }
  }
  const std::vector<glm::mat4> start = worldTransforms(scene, 0.0);
  placeInstances(scene, start, start, instances);
  return instances;
}

void placeInstances(const Scene& scene, const std::vector<glm::mat4>& current, const std::vector<glm::mat4>& previous,
                    std::vector<Instance>& instances) {
  for (Instance& instance : instances) {
    instance.worldFromObject = current[instance.node];
    instance.previousWorldFromObject = previous[instance.node];
    if (!isUsable(instance.worldFromObject) || !isUsable(instance.previousWorldFromObject)) {
      throw SceneError("node '" + scene.nodes[instance.node].name +
                       "': its transform is not finite or exceeds 1e6 scene units");
    }
    const glm::mat3 linear(instance.worldFromObject);
    instance.normalFromObject = cofactors(linear);
    instance.mirrored = glm::determinant(linear) < 0.0F;
  }
}

}  // namespace walr::render
