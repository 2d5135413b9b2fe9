#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "samples/render/surface.h"
#include "samples/render/view.h"
#include "samples/render/world.h"

namespace walr::render {

/// The noise-free values of one pixel, in the conventions of `walr::Frame` for the project's layout.
struct GBufferPixel {
  static constexpr std::uint32_t kSky = std::numeric_limits<std::uint32_t>::max();

  glm::vec3 position{0.0F};  ///< View space; 0 on sky.
  glm::vec3 normal{0.0F};    ///< View space shading normal towards the camera, unit; 0 on sky.
  glm::vec3 albedo{0.0F};    ///< Diffuse; 0 on sky and on metals.
  glm::vec3 emission{0.0F};  ///< Radiance of a visible emitter or of the sky, and of the mirrors in between.
  glm::vec3 motion{0.0F};    ///< Pixels to the previous frame, y down, between the jittered images; z: previous minus
                             ///< current view depth. On sky: motion of the ray's direction, z = 0.
  std::uint32_t objectId = kSky;  ///< Index of the instance (`World::instances`).
};

/// Which surface the G-buffer describes.
enum class GBufferMode : std::uint8_t {
  FirstHit,
  /// A mirror (`exact::isMirror`) is replaced by the virtual image of the surface that it reflects.
  BehindMirrors,
};

/// One pixel's G-buffer entry, and the surface in world space where its light is gathered.
struct PrimaryHit {
  GBufferPixel pixel;
  std::optional<Surface> surface;  ///< Nothing on sky.
  glm::vec3 tint{1.0F};            ///< Product of the reflection weights of the mirrors in between.
  glm::mat3 imageFromWorld{1.0F};  ///< From directions to those of the virtual image behind these mirrors.
};

/// Trace the ray through a pixel's sample position. For motion seen in mirrors, the mirrors are assumed not to move.
PrimaryHit tracePrimary(const World& world, const View& view, std::uint32_t x, std::uint32_t y,
                        GBufferMode mode = GBufferMode::FirstHit);

}  // namespace walr::render
