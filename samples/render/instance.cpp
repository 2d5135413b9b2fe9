#include "samples/render/instance.h"

#include <algorithm>
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

// Ray casting needs the inverse of the matrix. If there is none, returns a matrix close to it that has one: an object
// that is flattened along an axis gets a millionth of its size there.
glm::mat4 invertible(glm::mat4 m) {
  constexpr float kLeastScale = 1e-9F;
  constexpr float kThickness = 1e-6F;
  float size = kLeastScale;
  for (int axis = 0; axis < 3; ++axis) size = std::max(size, glm::length(glm::vec3(m[axis])));
  glm::mat3 directions(0.0F);  // Of the axes so far, perpendicular to each other.
  for (int axis = 0; axis < 3; ++axis) {
    const auto outside = [&](glm::vec3 v) {
      for (int before = 0; before < axis; ++before) v -= directions[before] * glm::dot(directions[before], v);
      return v;
    };
    glm::vec3 own = outside(glm::vec3(m[axis]));
    if (glm::length(own) < kThickness * size) {
      for (const glm::vec3 candidate : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        own = outside(candidate);
        if (glm::length(own) > 0.5F) break;  // One of three perpendicular directions always is.
      }
      own = kThickness * size * glm::normalize(own);
      m[axis] = glm::vec4(own, 0.0F);
    }
    directions[axis] = glm::normalize(own);
  }
  return m;
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
    instance.worldFromObject = invertible(instance.worldFromObject);
    instance.previousWorldFromObject = invertible(instance.previousWorldFromObject);
    const glm::mat3 linear(instance.worldFromObject);
    instance.normalFromObject = cofactors(linear);
    instance.mirrored = glm::determinant(linear) < 0.0F;
  }
}

}  // namespace walr::render
