#include "samples/render/view.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "samples/render/exact/path.h"
#include "samples/render/scene_error.h"

namespace walr::render {
namespace {

float radicalInverse(int base, int index) {
  float result = 0.0F;
  float digit = 1.0F;
  for (int rest = index; rest > 0; rest /= base) {
    digit /= static_cast<float>(base);
    result += digit * static_cast<float>(rest % base);
  }
  return result;
}

}  // namespace

std::vector<std::uint32_t> cameraNodes(const Scene& scene) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].camera) {
      nodes.push_back(i);
    }
  }
  return nodes;
}

std::uint32_t findCamera(const Scene& scene, const std::string& name) {
  const std::vector<std::uint32_t> nodes = cameraNodes(scene);
  if (nodes.empty()) {
    throw SceneError("the scene has no camera; add a perspective camera to a node of its default scene");
  }
  std::string known;
  for (const std::uint32_t node : nodes) {
    const std::string& camera = scene.cameras[*scene.nodes[node].camera].name;
    if (name.empty() || name == scene.nodes[node].name || name == camera) {
      return node;
    }
    known += (known.empty() ? "'" : ", '") + scene.nodes[node].name + "'";
  }
  throw SceneError("the scene has no camera '" + name + "'; its cameras: " + known);
}

glm::mat4 viewFromNode(const glm::mat4& worldFromNode, const std::string& name) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::abs(worldFromNode[3][axis]) <= kFarthestCamera)) {
      throw SceneError("camera node '" + name + "': its position is not finite or exceeds 1e6 scene units");
    }
  }
  const glm::vec3 back(worldFromNode[2]);
  const glm::vec3 right = glm::cross(glm::vec3(worldFromNode[1]), back);
  if (!(glm::length(back) > 0.0F) || !(glm::length(right) > 0.0F)) {
    throw SceneError("camera node '" + name + "': its transform gives no view direction; its scale must not be 0");
  }
  const glm::vec3 z = glm::normalize(back);
  const glm::vec3 x = glm::normalize(right);
  return glm::inverse(
      glm::mat4(glm::vec4(x, 0.0F), glm::vec4(glm::cross(z, x), 0.0F), glm::vec4(z, 0.0F), worldFromNode[3]));
}

View viewFrom(const World& world, std::uint32_t cameraNode, std::uint32_t width, std::uint32_t height,
              const glm::vec2& jitter, const glm::vec2& previousJitter) {
  const Node& node = world.scene().nodes[cameraNode];
  const Camera& camera = world.scene().cameras[*node.camera];
  View view;
  view.width = width;
  view.height = height;
  view.viewFromWorld = viewFromNode(world.nodes()[cameraNode], node.name);
  view.previousViewFromWorld = viewFromNode(world.previousNodes()[cameraNode], node.name);
  view.projection = glm::perspectiveRH_NO(camera.yfov, static_cast<float>(width) / static_cast<float>(height),
                                          camera.znear, camera.zfar);
  view.jitter = jitter;
  view.previousJitter = previousJitter;
  return view;
}

Ray primaryRay(const View& view, std::uint32_t x, std::uint32_t y) {
  const glm::mat4 worldFromView = glm::inverse(view.viewFromWorld);
  Ray ray;
  ray.origin = glm::vec3(worldFromView[3]);
  ray.direction =
      exact::primaryDirection({x, y}, view.jitter, {view.width, view.height}, view.projection, worldFromView);
  return ray;
}

glm::vec2 project(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = view.projection * glm::vec4(point, 1.0F);
  return {(0.5F + 0.5F * clip.x / clip.w) * static_cast<float>(view.width),
          (0.5F - 0.5F * clip.y / clip.w) * static_cast<float>(view.height)};
}

glm::vec2 haltonJitter(int frame) {
  constexpr int kPeriod = 16;
  const int index = ((frame % kPeriod) + kPeriod) % kPeriod + 1;
  return {radicalInverse(2, index) - 0.5F, radicalInverse(3, index) - 0.5F};
}

}  // namespace walr::render
