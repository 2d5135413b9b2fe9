#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "passes/conventions/light_pattern.h"
#include "samples/render/gbuffer.h"
#include "samples/render/resampling.h"
#include "samples/render/sampler.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "samples/sequence/frame.h"

namespace walr::render {

/// How the light of a frame is sampled.
struct SamplingSettings {
  std::uint32_t samples = 1;      ///< Samples per pixel, at least 1.
  std::uint32_t bounces = 4;      ///< See `tracePath`.
  std::uint32_t seed = 0;         ///< Frames of different seeds are independent.
  std::uint32_t firstSample = 0;  ///< Index of the first path in each pixel's sequence, which continues over frames.
  Sampler::Kind sampler = Sampler::Kind::Sobol;
  GBufferMode gbuffer = GBufferMode::FirstHit;
  /// Pixels without a sample get direct light only. The random numbers of the others are spread over the texels of the
  /// pattern.
  LightPattern light = {};
  glm::ivec2 lightOffset{0};  ///< See `FrameDescription::lightOffset`.
  /// Resample indirect light from frame to frame (`resample`); null: do not. Of the view's size. Glossy metals do not
  /// take part.
  Reservoirs* reservoirs = nullptr;
  unsigned int threads = 0;  ///< Number of threads; 0: one per core. The result does not depend on it.
  /// See `forEachTile`.
  std::function<void(std::uint64_t)> pixelsDone = [](std::uint64_t) {};
};

/// What a pixel's specular lobe reflects.
struct SpecularPixel {
  glm::vec3 light{0.0F};  ///< Mean of all light of `Lobe::Specular`, divided by `albedo`.
  /// Harmonic mean of `PathSample::distance`, because parallax goes with its inverse; 0 without a sample.
  float distance = 0.0F;
  /// Mean of `PathSample::motion`, as `PrimaryHit::imageFromWorld` turns it; 0 without a sample.
  glm::vec3 motion{0.0F};
  /// See `specularAlbedo`; times `PrimaryHit::tint`. 0 on sky, like `roughness`.
  glm::vec3 albedo{0.0F};
  float roughness = 0.0F;
};

/// A distance from the mean of its inverses: at most `kBackgroundDepth`, which stands for paths that met nothing.
inline float distanceOf(double inverse) {
  return static_cast<float>(1.0 / std::max(inverse, 1.0 / double{kBackgroundDepth}));
}

/// One rendered frame: rows from the top, no padding.
struct Film {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<GBufferPixel> gbuffer;
  std::vector<glm::vec3> direct;        ///< Mean of `PathSample::direct`; 0 where the albedo is 0.
  std::vector<glm::vec3> indirect;      ///< Mean of `PathSample::indirect`; 0 where the albedo is 0.
  std::vector<SpecularPixel> specular;  ///< Empty without `Scene::specular`.
  std::uint64_t rays = 0;               ///< Rays traced.
};

/// Render a frame: one primary ray per pixel, and `settings.samples` paths from the point that it hits.
Film renderFilm(const World& world, const View& view, const SamplingSettings& settings);

}  // namespace walr::render
