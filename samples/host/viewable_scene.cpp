#include "samples/host/viewable_scene.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "samples/render/animation.h"
#include "samples/render/load_scene.h"
#include "samples/render/view.h"

namespace walr::host {
namespace {

void addCamera(render::Scene& scene) {
  const glm::vec4 sphere = boundingSphere(scene, render::worldTransforms(scene, 0.0));
  const glm::vec3 centre(sphere);
  const glm::vec3 direction = glm::normalize(glm::vec3(0.5F, 0.35F, 1.0F));  // From the front, a little from above.
  render::Camera camera;
  const glm::vec3 eye = centre + direction * (sphere.w / std::sin(0.5F * camera.yfov));
  render::Node node;
  node.name = "camera";
  node.matrix = glm::inverse(glm::lookAt(eye, centre, glm::vec3(0.0F, 1.0F, 0.0F)));
  node.camera = static_cast<std::uint32_t>(scene.cameras.size());
  scene.cameras.push_back(camera);
  scene.nodes.push_back(node);
  scene.warnings.emplace_back("the scene has no camera: it is seen from the front");
}

}  // namespace

render::Scene loadViewableScene(const std::filesystem::path& file, const std::filesystem::path& sky) {
  render::Scene scene = render::loadScene(file, sky);
  if (render::cameraNodes(scene).empty()) addCamera(scene);
  if (std::erase(scene.warnings, render::kNoLightWarning) > 0) {
    scene.skyRadiance = glm::vec3(1.0F);
    scene.warnings.emplace_back("the scene has no light: it is shown under a white sky");
  }
  return scene;
}

glm::vec4 boundingSphere(const render::Scene& scene, std::span<const glm::mat4> worldFromNode) {
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    for (const std::uint32_t mesh : scene.nodes[i].meshes) {
      for (const glm::vec3& position : scene.meshes[mesh].positions) {
        const glm::vec3 point(worldFromNode[i] * glm::vec4(position, 1.0F));
        low = glm::min(low, point);
        high = glm::max(high, point);
      }
    }
  }
  return {0.5F * (low + high), 0.5F * glm::distance(low, high)};
}

}  // namespace walr::host
