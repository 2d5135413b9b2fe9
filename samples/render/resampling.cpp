#include "samples/render/resampling.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "samples/image/luminance.h"

namespace walr::render {
namespace {

// A reservoir is of the same surface if it lies on the surface's plane, up to a share of the distance to the camera,
// and faces the same way.
constexpr float kPlaneTolerance = 0.01F;
constexpr float kLeastCosine = 0.9F;

float luminanceOf(const glm::vec3& colour) {
  return static_cast<float>(luminance(std::span<const float>(&colour.x, 3)));
}

// Solid angle that a small area around the source takes as seen from a point, relative to its area; 0 from behind it.
float solidAngle(const IndirectSource& source, const glm::vec3& point) {
  const glm::vec3 offset = point - source.position;
  const float squared = glm::dot(offset, offset);
  return squared > 0.0F ? std::max(glm::dot(source.normal, offset), 0.0F) / (squared * std::sqrt(squared)) : 0.0F;
}

// Whether nothing is between the origin of a ray and a source.
bool sees(const World& world, const glm::vec3& origin, const IndirectSource& source) {
  // The ray ends slightly before the source, so that it does not hit the source itself.
  constexpr float kBeforeTheEnd = 1.0F - 1e-3F;
  return !world.rays().occluded({origin, source.position - origin, kBeforeTheEnd});
}

// Whether paths of the previous frame could have found a source.
bool couldReach(const World& world, const Reservoir& reservoir, const IndirectSource& source) {
  return solidAngle(source, reservoir.position) > 0.0F &&
         glm::dot(reservoir.normal, source.position - reservoir.position) > 0.0F &&
         sees(world, reservoir.position + reservoir.normal * reservoir.rayOffset, source);
}

// Weight of the previous reservoir's source at a surface point, counted as `samples` samples; 0 if the point does not
// see it. Counts rays.
float weightOfReused(const World& world, const Surface& surface, const Reservoir& previous, float samples,
                     std::uint32_t& rays) {
  if (!(previous.weight > 0.0F)) return 0.0F;
  const float before = solidAngle(previous.source, previous.position);
  const float target = luminanceOf(contribution(world, surface, previous.source));
  if (!(before > 0.0F) || !(target > 0.0F)) return 0.0F;
  ++rays;
  const glm::vec3 origin = rayOrigin(surface, previous.source.position - surface.position);
  if (!sees(world, origin, previous.source)) return 0.0F;
  // The density is per solid angle, which differs between this surface point and the previous one.
  const float weight = previous.weight * solidAngle(previous.source, surface.position) / before;
  return samples * target * weight;
}

// Weighted reservoir sampling: keeps one of the sources offered, with a probability proportional to its weight.
class Choice {
 public:
  explicit Choice(Sampler& sampler) : sampler_(sampler) {}

  // Returns whether the source was taken.
  bool offer(const IndirectSource& source, float weight) {
    sum_ += weight;
    if (!(weight > 0.0F) || sampler_.next1D() * sum_ >= weight) return false;
    source_ = source;
    return true;
  }
  [[nodiscard]] const IndirectSource& source() const { return source_; }
  [[nodiscard]] float sum() const { return sum_; }

 private:
  Sampler& sampler_;
  IndirectSource source_;
  float sum_ = 0.0F;
};

}  // namespace

Reservoirs::Reservoirs(std::uint32_t width, std::uint32_t height, float mostFrames)
    : width_(width),
      height_(height),
      mostFrames_(mostFrames),
      current_(static_cast<std::size_t>(width) * height),
      previous_(current_.size()) {}

Reservoir Reservoirs::previous(std::uint32_t x, std::uint32_t y, const PrimaryHit& hit) const {
  const float column = std::floor(static_cast<float>(x) + 0.5F + hit.pixel.motion.x);
  const float row = std::floor(static_cast<float>(y) + 0.5F + hit.pixel.motion.y);
  const bool inside = column >= 0.0F && row >= 0.0F && column < static_cast<float>(width_) &&
                      row < static_cast<float>(height_);  // Not so if motion is NaN.
  if (!inside || !hit.surface) return {};
  const Reservoir& found = previous_[index(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row))];
  const float distance = std::abs(glm::dot(found.normal, hit.surface->previousPosition - found.position));
  const bool same = found.objectId == hit.pixel.objectId &&
                    glm::dot(found.normal, hit.surface->geometricNormal) >= kLeastCosine &&
                    distance <= kPlaneTolerance * glm::length(hit.pixel.position);
  return same ? found : Reservoir{};
}

void Reservoirs::nextFrame() {
  std::swap(current_, previous_);
  std::fill(current_.begin(), current_.end(), Reservoir{});
}

ResampledLight resample(const World& world, const PrimaryHit& hit, std::span<const PathSample> paths,
                        const Reservoir& previous, float mostFrames, Sampler& sampler) {
  const Surface& surface = *hit.surface;
  ResampledLight result;
  Choice choice(sampler);
  for (const PathSample& path : paths) {
    // The density of a path's direction is that of its contribution but for the luminance.
    if (path.source) choice.offer(*path.source, luminanceOf(path.indirect));
  }
  const auto newSamples = static_cast<float>(paths.size());
  const float reusedSamples = std::min(previous.samples, mostFrames * newSamples);
  const float weight = weightOfReused(world, surface, previous, reusedSamples, result.rays);
  const bool reused = choice.offer(previous.source, weight);

  result.reservoir = {surface.position,          surface.geometricNormal, surface.rayOffset,
                      hit.pixel.objectId,        choice.source(),         0.0F,
                      newSamples + reusedSamples};
  if (!(choice.sum() > 0.0F)) return result;
  float counted = newSamples + reusedSamples;
  if (!reused && reusedSamples > 0.0F) {
    // Samples that could not have found the chosen source do not count (Ouyang et al. 2021, algorithm 4).
    ++result.rays;
    if (!couldReach(world, previous, choice.source())) counted = newSamples;
  }
  const glm::vec3 chosen = contribution(world, surface, choice.source());
  const float target = luminanceOf(chosen);
  if (!(target > 0.0F)) return result;
  result.reservoir.weight = choice.sum() / (counted * target);
  result.indirect = chosen * result.reservoir.weight;
  return result;
}

}  // namespace walr::render
