#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/sampler.h"
#include "samples/render/surface.h"
#include "samples/render/world.h"

/// What metals show: the classes of materials in Fu 2022, which follow from glTF's metallic and roughness.
namespace walr::render {

/// The classes of surfaces that `GBufferMode::Material` distinguishes.
enum class Gloss : std::uint8_t {
  Diffuse,   ///< Metallic below 0.5.
  Glossy,    ///< Metallic from 0.5 on, roughness above 0.1: reflects other surfaces blurred.
  Specular,  ///< Metallic from 0.5 on, roughness up to 0.1: a mirror.
};
Gloss glossOf(const Surface& surface);

/// A direction of reflection, and the ratio of the light that the surface reflects to the light that arrives from
/// there.
struct Reflection {
  glm::vec3 direction{0.0F};  ///< Unit.
  glm::vec3 weight{0.0F};     ///< 0 if the direction leads below the surface.
};

/// The reflection of a mirror.
Reflection mirrored(const Surface& surface);

/// Sample a reflection of a rough metal by the distribution of visible normals (`exact::specularLobe`).
Reflection sampleReflection(const Surface& surface, const glm::vec2& random);

/// The result of a path from a glossy surface to the first surface that is not a metal.
struct GlossySample {
  glm::vec3 albedo{0.0F};  ///< Product of the reflections' weights and the albedo found, which is 1 for lamps and sky.
  glm::vec3 radiance{0.0F};  ///< Towards the viewer.
  std::uint32_t rays = 0;
};

/// Trace one path from a glossy surface.
/// @param bounces  see `tracePath`, which continues the path from the surface found
/// @param lit      false: only find the albedo, without tracing light there
GlossySample traceGlossy(const World& world, const Surface& surface, std::uint32_t bounces, Sampler& sampler, bool lit);

}  // namespace walr::render
