#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "samples/render/sampler.h"
#include "samples/render/surface.h"
#include "samples/render/world.h"

/// What metals show: the classes of Fu 2022, told by glTF's metallic and roughness.
namespace walr::render {

/// How a surface's G-buffer is made where it is blended by material.
enum class Gloss : std::uint8_t {
  Diffuse,   ///< Metallic below 0.5: shows itself.
  Glossy,    ///< A metal of roughness above 0.1: shows others, blurred.
  Specular,  ///< Any other metal: a mirror.
};
Gloss glossOf(const Surface& surface);

/// A direction of reflection, and the light that the surface passes on from there over that which arrives.
struct Reflection {
  glm::vec3 direction{0.0F};  ///< Unit.
  glm::vec3 weight{0.0F};     ///< 0 where the direction leads under the surface.
};

/// That of a mirror.
Reflection mirrored(const Surface& surface);

/// One of a rough metal's, distributed as the normals that the viewer sees: GGX with Smith's height-correlated masking
/// and Schlick's Fresnel term, glTF 2.0 appendix B; sampled by spherical caps (J. Dupuy and A. Benyoub, "Sampling
/// Visible GGX Normals with Spherical Caps", HPG 2023).
Reflection sampleReflection(const Surface& surface, const glm::vec2& random);

/// What a path from a glossy surface finds at the first one that is not a metal.
struct GlossySample {
  glm::vec3 albedo{0.0F};    ///< Product of the reflections' weights and the albedo found; of lamps and sky, 1.
  glm::vec3 radiance{0.0F};  ///< Towards the viewer.
  std::uint32_t rays = 0;
};

/// Trace one path from a glossy surface.
/// @param bounces  see `tracePath`, which goes on from what is found
/// @param lit      false: find the albedo only
GlossySample traceGlossy(const World& world, const Surface& surface, std::uint32_t bounces, Sampler& sampler, bool lit);

}  // namespace walr::render
