#include "samples/sequence/reflection_linter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "passes/lint/lint_inputs.h"
#include "samples/sequence/frame_pixels.h"

namespace walr {
namespace {

/// Up to this roughness a pixel shows one image (passes/SPECULAR.md).
constexpr float kMirrorUpTo = 0.05F;
/// Over depth: a point so near to a surface lies on it. Lobes of mirrors are .005 radians wide.
constexpr float kOnSurface = 0.02F;
/// Pixels; what moves by less says little, because motion is in halves.
constexpr float kLeastMotion = 0.5F;

/// Few mirrors show what moves, but a wrong convention is wrong in all of them.
constexpr std::uint64_t kLeastMovingPoints = 20;

/// View ray of a position in pixels, with z = -1.
glm::vec3 rayThrough(glm::vec4 rayFromPixel, glm::vec2 position) {
  return {position * glm::vec2(rayFromPixel) + glm::vec2(rayFromPixel.z, rayFromPixel.w), -1.0F};
}

std::size_t indexOf(const Frame& frame, glm::ivec2 p) {
  return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(frame.depth.width()) + static_cast<std::size_t>(p.x);
}

/// Position in the view space of the frame.
glm::vec3 positionAt(const Frame& frame, const FrameConstants& constants, glm::ivec2 p) {
  return rayThrough(constants.rayFromPixel, glm::vec2(p) + 0.5F) * frame.depth.at(p.x, p.y, 0);
}

}  // namespace

void ReflectionLinter::add(const Frame& frame, const FrameConstants& constants) {
  if (frame.specularDistance.empty() || frame.roughness.empty()) return;
  for (int y = 0; y < frame.depth.height(); ++y) {
    for (int x = 0; x < frame.depth.width(); ++x) {
      const float distance = frame.specularDistance.at(x, y, 0);
      const float roughness = frame.roughness.at(x, y, 0);
      if (!isSurface(frame, indexOf(frame, {x, y})) || !(roughness >= 0.0F && roughness <= kMirrorUpTo)) continue;
      if (distance > 0.0F && distance < kSkyDepth) addMirror(frame, constants, {x, y}, distance);
    }
  }
}

void ReflectionLinter::addMirror(const Frame& frame, const FrameConstants& constants, glm::ivec2 pixel,
                                 float distance) {
  const glm::vec3 position = positionAt(frame, constants, pixel);
  glm::vec3 normal = vectorAt(frame.normal, indexOf(frame, pixel));
  if (conventions_.normal == InputConventions::Space::World) normal = glm::mat3(constants.viewFromWorld) * normal;
  if (!isFinite(normal) || glm::length(normal) < 0.5F) return;
  const glm::vec3 mirrored = glm::reflect(glm::normalize(position), glm::normalize(normal));
  const std::optional<glm::ivec2> shown = addPoint(frame, constants, position + distance * mirrored, given_);
  const float rest = distance - glm::length(position);
  if (rest > 0.0F) addPoint(frame, constants, position + rest * mirrored, fromEye_);
  if (!shown || frame.specularMotion.empty() || frame.resetHistory) return;
  const glm::vec3 told = vectorAt(frame.specularMotion, indexOf(frame, pixel));
  if (isFinite(told)) addMotion(frame, constants, told, *shown);
}

std::optional<glm::ivec2> ReflectionLinter::addPoint(const Frame& frame, const FrameConstants& constants,
                                                     glm::vec3 point, Points& points) {
  if (!(point.z < 0.0F)) return std::nullopt;
  const glm::vec2 offset(constants.rayFromPixel.z, constants.rayFromPixel.w);
  const glm::vec2 place = (glm::vec2(point) / -point.z - offset) / glm::vec2(constants.rayFromPixel);
  const glm::vec2 size(frame.depth.width(), frame.depth.height());
  // One pixel around it is looked at, too.
  if (!(place.x >= 1.0F && place.y >= 1.0F && place.x < size.x - 1.0F && place.y < size.y - 1.0F)) return std::nullopt;
  const glm::ivec2 pixel(place);
  const auto liesAt = [&](float depth) { return std::abs(depth + point.z) <= -kOnSurface * point.z; };
  bool seen = false;
  bool inAir = true;
  for (int i = 0; i < 9; ++i) {
    const float depth = frame.depth.at(pixel.x + i % 3 - 1, pixel.y + i / 3 - 1, 0);
    seen = seen || liesAt(depth);
    inAir = inAir && depth > -(1.0F + kOnSurface) * point.z;
  }
  points.seen += seen ? 1 : 0;
  points.inAir += inAir ? 1 : 0;
  return liesAt(frame.depth.at(pixel.x, pixel.y, 0)) ? std::optional(pixel) : std::nullopt;
}

void ReflectionLinter::addMotion(const Frame& frame, const FrameConstants& constants, glm::vec3 told, glm::ivec2 at) {
  if (conventions_.motionDepth != InputConventions::MotionDepth::Given) return;
  const float depth = frame.depth.at(at.x, at.y, 0);
  const glm::vec3 motion = vectorAt(frame.motion, indexOf(frame, at));
  glm::vec2 before = glm::vec2(at) + 0.5F + glm::vec2(motion) * constants.motionScale;
  if (!conventions_.motionJittered) before += constants.jitterDelta;
  const glm::vec3 previous = rayThrough(constants.previousRayFromPixel, before) * (depth + motion.z);
  const glm::vec3 position = positionAt(frame, constants, at);
  // In view space of this frame, as a still camera sees it.
  const glm::vec3 moved =
      glm::vec3(glm::inverse(constants.previousViewFromView) * glm::vec4(previous, 1.0F)) - position;
  if (!isFinite(moved) || glm::length(moved) < kLeastMotion * depth * std::abs(constants.rayFromPixel.y)) return;
  const glm::vec3 turned = glm::mat3(constants.viewFromWorld) * told;
  const std::array readings{turned, -turned, told, glm::vec3(0.0F)};
  std::array<float, readings.size()> errors{};
  std::ranges::transform(readings, errors.begin(), [&](glm::vec3 reading) { return glm::distance(reading, moved); });
  if (told == glm::vec3(0.0F)) errors = {1.0F, 1.0F, 1.0F, 0.0F};
  // Only one that is clearly nearer than the others counts.
  const auto best = std::ranges::min_element(errors);
  const auto alike = std::ranges::count_if(errors, [&](float error) { return error <= 2.0F * *best; });
  if (alike == 1) ++motions_.at(static_cast<std::size_t>(best - errors.begin()));
}

std::vector<LintFinding> ReflectionLinter::findings() const {
  std::vector<LintFinding> found;
  const bool inAir = isMost(given_.inAir, given_.seen + given_.inAir);
  // Points too far away lie behind what the picture shows, and say nothing.
  const bool fromEye =
      !isMost(fromEye_.inAir, fromEye_.seen + fromEye_.inAir) && isMost(fromEye_.seen, fromEye_.seen + given_.seen);
  if (inAir || fromEye) {
    const Points& points = fromEye ? fromEye_ : given_;
    const std::uint64_t whole = points.seen + points.inAir;
    const std::string what =
        fromEye
            ? share(fromEye_.seen, whole, "points that mirrors show lie on a surface if the distance begins at the eye")
            : share(given_.inAir, whole, "points that mirrors show are in the air, where the picture shows no surface");
    found.push_back(
        {"specular-distance-of-another-ray", what,
         fromEye ? "the distance was measured from the eye"
                 : "the distance is that of another ray, such as the diffuse one, or in other units",
         "write the distance from the mirror's surface to the first hit of the specular path, scene units"});
  }
  constexpr std::array<std::string_view, 3> kNames{"specular-motion-sign", "specular-motion-space",
                                                   "specular-motion-missing"};
  constexpr std::array<std::string_view, 3> kTexts{" move the opposite way", " move so in view space",
                                                   " move, and are told to be still"};
  constexpr std::array<std::string_view, 3> kCauses{"it is this frame's position minus the previous one's",
                                                    "it was turned into view space",
                                                    "the motion of what a ray hits was not written where it moves"};
  std::uint64_t all = 0;
  for (const std::uint64_t each : motions_) all += each;
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const std::uint64_t part = motions_.at(i + 1);
    if (all < kLeastMovingPoints || 10 * part < 9 * all) continue;
    found.push_back({kNames.at(i),
                     "by the motion of the same surfaces where they are seen directly, " +
                         share(part, all, "points that mirrors show") + std::string(kTexts.at(i)),
                     kCauses.at(i),
                     "write where the first hit of the specular path was in the previous frame, minus where it is, in "
                     "world space"});
  }
  return found;
}

}  // namespace walr
