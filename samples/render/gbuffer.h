#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/vec3.hpp>

#include "samples/render/surface.h"
#include "samples/render/view.h"
#include "samples/render/world.h"

namespace walr::render {

/// What a pixel shows, free of noise. Conventions as everywhere in the project.
struct GBufferPixel {
  static constexpr std::uint32_t kSky = std::numeric_limits<std::uint32_t>::max();

  glm::vec3 position{0.0F};  ///< View space; 0 on sky.
  glm::vec3 normal{0.0F};    ///< View space shading normal towards the camera, unit; 0 on sky.
  glm::vec3 albedo{0.0F};    ///< Diffuse; 0 on sky and, with `GBufferMode::FirstHit`, on metals.
  glm::vec3 emission{0.0F};  ///< Radiance of a visible emitter or of the sky.
  glm::vec3 motion{0.0F};    ///< Pixels to the previous frame, y down, between the jittered images; z: previous minus
                             ///< current view depth. On sky that of the direction, z = 0.
  std::uint32_t objectId = kSky;  ///< Index of the instance (`World::instances`).
};

/// What of a pixel the G-buffer tells.
enum class GBufferMode : std::uint8_t {
  FirstHit,  ///< The first surface. Metals show no light.
  /// Blended by material (Fu 2022): in a mirror the image of what it shows, as if that stood behind it; of a
  /// glossy metal its own depth and normal, its albedo mixed with those of what it shows.
  Material,
};

/// One pixel's G-buffer entry with the surface in world space that light is gathered at.
struct PrimaryHit {
  GBufferPixel pixel;
  std::optional<Surface> surface;  ///< Nothing on sky.
  glm::vec3 tint{1.0F};            ///< By which mirrors on the way change the light.
};

/// Trace the ray through a pixel's sample position. Mirrors are taken to have stood where they are one frame ago.
PrimaryHit tracePrimary(const World& world, const View& view, std::uint32_t x, std::uint32_t y,
                        GBufferMode mode = GBufferMode::FirstHit);

}  // namespace walr::render
