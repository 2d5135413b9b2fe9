#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include <glm/vec3.hpp>

#include "samples/render/sampler.h"
#include "samples/render/surface.h"
#include "samples/render/world.h"

namespace walr::render {

/// Which part of the light that arrives at a path's first vertex is wanted.
enum class Lobe : std::uint8_t {
  Diffuse,   ///< That of the diffuse lobe, demodulated: irradiance / pi, so that albedo times this is the radiance.
  Specular,  ///< The radiance that the specular lobe reflects. Only with `Scene::specular`.
};

/// A path's second vertex, as the source of indirect light at its first.
struct IndirectSource {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F};    ///< Of the triangle, unit, towards the first vertex.
  glm::vec3 radiance{0.0F};  ///< Reflected towards the first vertex, without emission.
};

/// The light that one path brings to a surface point, in the unit of its `Lobe`.
struct PathSample {
  /// Light that arrives directly from lights, emissive surfaces and the sky.
  glm::vec3 direct{0.0F};
  /// Light that was reflected by at least one other surface.
  glm::vec3 indirect{0.0F};
  /// Where `indirect` comes from; nothing if the path met no surface after the first.
  std::optional<IndirectSource> source;
  /// Length of the path's first segment; infinite if it met nothing.
  float distance = std::numeric_limits<float>::infinity();
  /// Where the end of the path's first segment was one frame ago, minus where it is; 0 if it met nothing.
  glm::vec3 motion{0.0F};
  /// Rays traced.
  std::uint32_t rays = 0;
};

/// Trace one path from a surface point. The estimate is unbiased and not clamped.
///
/// Every vertex samples light in two ways: by next-event estimation, and by the direction in which the path continues,
/// which is cosine-distributed or, for the specular lobe, a reflection at a visible normal. With `Scene::specular`, the
/// first vertex has one lobe, and each later vertex has both and continues by one of them. Next-event estimation takes
/// all punctual lights at the first vertex, so that their direct light has no noise, and one random punctual light at
/// later vertices; one point of the emissive triangles; and one direction of the sky map. Both ways find emissive
/// triangles and the sky map, so the balance heuristic (Veach and Guibas 1995) weights them. Only the continued path
/// finds a constant sky. Emission and sky that the first direction meets are direct light.
/// @param bounces  number of surfaces after the first that reflect light; 0 gives no indirect light
PathSample tracePath(const World& world, const Surface& first, std::uint32_t bounces, Sampler& sampler,
                     Lobe lobe = Lobe::Diffuse);

/// The albedo by which a surface's specular light is divided.
glm::vec3 specularAlbedo(const Surface& surface);

/// What a source contributes to the demodulated indirect light of a surface, per solid angle: radiance x lobe x cosine
/// / pi. Whether the surface sees the source is not tested.
glm::vec3 contribution(const World& world, const Surface& surface, const IndirectSource& source);

}  // namespace walr::render
