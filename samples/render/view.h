#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/ray_caster.h"
#include "samples/render/scene.h"
#include "samples/render/world.h"

namespace walr::render {

/// A camera's coordinates reach to it, in scene units.
inline constexpr float kFarthestCamera = 1e6F;

/// A camera in one frame and in the frame before. Pixel positions: x right, y down, the centre of pixel (i, j) at
/// (i + 0.5, j + 0.5). View space: right-handed, the camera looks down -Z.
struct View {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  glm::mat4 viewFromWorld{1.0F};  ///< Rigid.
  glm::mat4 previousViewFromWorld{1.0F};
  glm::mat4 projection{1.0F};  ///< OpenGL clip space (z_ndc in -1..1), without jitter.
  glm::vec2 jitter{0.0F};      ///< Pixels: sample position minus pixel centre.
  glm::vec2 previousJitter{0.0F};
};

/// The nodes of a scene that have a camera: indices into `Scene::nodes`.
std::vector<std::uint32_t> cameraNodes(const Scene& scene);

/// The first node with a camera where the node's or the camera's name is `name`; the first of all if `name` is empty.
/// @throws SceneError naming the scene's cameras
std::uint32_t findCamera(const Scene& scene, const std::string& name);

/// The matrix from world to view space of a camera, from its node's world transform without scale and shear.
/// @param name  name of the node, for the error message
/// @throws SceneError if the node's axes have no extent
glm::mat4 viewFromNode(const glm::mat4& worldFromNode, const std::string& name);

/// The view from a node with a camera. The aspect ratio is that of `width` x `height`, not that of the camera; the
/// vertical field of view is the camera's.
/// @throws SceneError if the node's axes have no extent
View viewFrom(const World& world, std::uint32_t cameraNode, std::uint32_t width, std::uint32_t height,
              const glm::vec2& jitter, const glm::vec2& previousJitter);

/// The ray through a pixel's sample position; its direction is unit.
Ray primaryRay(const View& view, std::uint32_t x, std::uint32_t y);

/// The pixel position, without jitter, of a point in view space.
/// @param point  in front of the camera: z < 0
glm::vec2 project(const View& view, const glm::vec3& point);

/// A low-discrepancy jitter within the pixel: Halton points of bases 2 and 3, minus 0.5. It repeats every 16 frames.
glm::vec2 haltonJitter(int frame);

}  // namespace walr::render
