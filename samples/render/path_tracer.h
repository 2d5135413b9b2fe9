#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "samples/render/sampler.h"
#include "samples/render/surface.h"
#include "samples/render/world.h"

namespace walr::render {

/// What one path brings to a diffuse surface point, demodulated: irradiance / pi, so that radiance is albedo times it.
struct PathSample {
  /// Light that comes straight from lights, emissive surfaces and the sky.
  glm::vec3 direct{0.0F};
  /// Light that at least one other surface reflected.
  glm::vec3 indirect{0.0F};
  /// Rays traced.
  std::uint32_t rays = 0;
};

/// Trace one path from a surface point: an unbiased estimate without any clamping.
///
/// At every vertex light is sampled in two ways: next-event estimation (every punctual light at the first vertex, so
/// that hard-edged light is free of noise, one of them at later ones; one point of the emissive triangles) and the
/// cosine-distributed direction in which the path goes on. Emissive triangles are found by both; the balance heuristic
/// (Veach and Guibas 1995) weights them. So it is with a sky from a map; a constant one is found by the latter
/// alone. What the first direction meets of emission or sky is direct light.
/// @param bounces  surfaces after the first that reflect light: 0 gives no indirect light
PathSample tracePath(const World& world, const Surface& first, std::uint32_t bounces, Sampler& sampler);

}  // namespace walr::render
