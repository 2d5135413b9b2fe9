#include "samples/render/default_view.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/animation.h"
#include "samples/render/scene_error.h"
#include "samples/render/view.h"

namespace walr::render {

Box boundingBox(const Scene& scene, std::span<const glm::mat4> worldFromNode) {
  Box box{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    for (const std::uint32_t mesh : scene.nodes[i].meshes) {
      for (const glm::vec3& position : scene.meshes[mesh].positions) {
        const glm::vec3 point(worldFromNode[i] * glm::vec4(position, 1.0F));
        box.low = glm::min(box.low, point);
        box.high = glm::max(box.high, point);
      }
    }
  }
  return box;
}

void addFramingCamera(Scene& scene) {
  constexpr float kMargin = 1.05F;
  const Box box = boundingBox(scene, worldTransforms(scene, 0.0));
  const glm::vec3 centre = 0.5F * (box.low + box.high);
  const glm::vec3 back = glm::normalize(glm::vec3(0.7F, 0.5F, 1.0F));
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), back));
  const glm::vec3 up = glm::cross(back, right);
  Camera camera;
  const float slope = std::tan(0.5F * camera.yfov) / kMargin;
  float distance = 0.0F;
  for (unsigned i = 0; i < 8; ++i) {
    const glm::vec3 corner =
        glm::mix(box.low, box.high, glm::vec3(glm::uvec3(i, i >> 1U, i >> 2U) & glm::uvec3(1U))) - centre;
    const float half = glm::max(std::abs(glm::dot(corner, right)), std::abs(glm::dot(corner, up)));
    distance = glm::max(distance, glm::dot(corner, back) + half / slope);
  }
  if (!(distance > 0.0F)) distance = 1.0F;  // All vertices lie in one point.
  camera.znear = 0.01F * distance;
  camera.zfar = 100.0F * distance;
  const glm::vec3 position = centre + distance * back;
  const glm::vec3 size = glm::abs(position);
  if (!(glm::max(size.x, glm::max(size.y, size.z)) <= kFarthestCamera)) {
    throw SceneError(
        "the scene has no camera, and one that frames all of it would be farther than 1e6 scene units from the origin; "
        "add a camera, or make the scene smaller");
  }
  Node node;
  node.name = "camera";
  node.matrix =
      glm::mat4(glm::vec4(right, 0.0F), glm::vec4(up, 0.0F), glm::vec4(back, 0.0F), glm::vec4(position, 1.0F));
  node.camera = static_cast<std::uint32_t>(scene.cameras.size());
  scene.cameras.push_back(camera);
  scene.nodes.push_back(node);
}

}  // namespace walr::render
