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

/// What a camera sees in one frame, and what it saw in the frame before. Pixel positions: x right, y down, the centre
/// of pixel (i, j) at (i + 0.5, j + 0.5). View space: right-handed, the camera looks down -Z.
struct View {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  glm::mat4 viewFromWorld{1.0F};  ///< Rigid.
  glm::mat4 previousViewFromWorld{1.0F};
  glm::mat4 projection{1.0F};  ///< OpenGL clip space (z_ndc in -1..1), without jitter.
  glm::vec2 jitter{0.0F};      ///< Pixels: sample position minus pixel centre.
  glm::vec2 previousJitter{0.0F};
};

/// Nodes of a scene that hold a camera: indices into `Scene::nodes`.
std::vector<std::uint32_t> cameraNodes(const Scene& scene);

/// The node with a camera of that name (its own or its camera's), or the first one for an empty name.
/// @throws SceneError naming the cameras that there are
std::uint32_t findCamera(const Scene& scene, const std::string& name);

/// World to view space of a camera whose node stands so in the world: its scale and shear do not count.
/// @param name  of the node, for the error's text
/// @throws SceneError if the node's axes have no extent
glm::mat4 viewFromNode(const glm::mat4& worldFromNode, const std::string& name);

/// The view from a node with a camera. The picture's aspect is that of `width` x `height`; the camera's vertical field
/// of view is kept.
/// @throws SceneError if the node's axes have no extent
View viewFrom(const World& world, std::uint32_t cameraNode, std::uint32_t width, std::uint32_t height,
              const glm::vec2& jitter, const glm::vec2& previousJitter);

/// The ray through a pixel's sample position, its direction unit.
Ray primaryRay(const View& view, std::uint32_t x, std::uint32_t y);

/// Where a point of view space appears: unjittered pixel position.
/// @param point  in front of the camera: z < 0
glm::vec2 project(const View& view, const glm::vec3& point);

/// A low-discrepancy jitter within the pixel that repeats every 16 frames: Halton points of bases 2 and 3, minus 0.5.
glm::vec2 haltonJitter(int frame);

}  // namespace walr::render
