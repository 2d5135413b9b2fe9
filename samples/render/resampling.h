#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "samples/render/gbuffer.h"
#include "samples/render/path_tracer.h"
#include "samples/render/sampler.h"
#include "samples/render/world.h"

namespace walr::render {

/// A sample of indirect light that a pixel keeps for the next frame, and what its weight needs (Ouyang et al. 2021, 4).
struct Reservoir {
  // The surface that the pixel shows.
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F};  ///< Of the triangle.
  float rayOffset = 0.0F;  ///< See `Surface::rayOffset`.
  std::uint32_t objectId = GBufferPixel::kSky;

  IndirectSource source;
  float weight = 0.0F;   ///< Estimate of 1 / density of `source`, per solid angle; 0: there is no sample.
  float samples = 0.0F;  ///< Number of samples that `source` was chosen from, called M in the paper.
};

/// The reservoirs of all pixels, of this frame and of the one before.
class Reservoirs {
 public:
  /// @param mostFrames  how many frames' worth of samples a reservoir of the previous frame counts at most
  Reservoirs(std::uint32_t width, std::uint32_t height, float mostFrames);

  /// The reservoir of the previous frame for the pixel (x, y), which now shows `hit`. One without samples if the
  /// pixel's surface was outside the image or another surface was in front of it.
  [[nodiscard]] Reservoir previous(std::uint32_t x, std::uint32_t y, const PrimaryHit& hit) const;
  /// The reservoir of this frame. Different pixels may be written by different threads.
  Reservoir& current(std::uint32_t x, std::uint32_t y) { return current_[index(x, y)]; }
  [[nodiscard]] float mostFrames() const { return mostFrames_; }

  /// This frame becomes the previous one.
  void nextFrame();

 private:
  [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const {
    return static_cast<std::size_t>(y) * width_ + x;
  }

  std::uint32_t width_;
  std::uint32_t height_;
  float mostFrames_;
  std::vector<Reservoir> current_;
  std::vector<Reservoir> previous_;
};

/// Indirect light of a pixel from a reservoir.
struct ResampledLight {
  Reservoir reservoir;
  glm::vec3 indirect{0.0F};
  std::uint32_t rays = 0;  ///< Rays traced, which test whether surfaces see sources.
};

/// Choose one of this frame's paths and of the previous reservoir's source, with probabilities proportional to the
/// luminance that they bring (resampled importance sampling; Ouyang et al. 2021, 4.2). The expected value is that of
/// the paths, as long as the sources' radiance does not change: a source keeps the radiance that it was traced with.
/// @param paths  of this frame, at least one, from `hit`
ResampledLight resample(const World& world, const PrimaryHit& hit, std::span<const PathSample> paths,
                        const Reservoir& previous, float mostFrames, Sampler& sampler);

}  // namespace walr::render
