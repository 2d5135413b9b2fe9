#include "tests/passes/reference/reflection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "tests/passes/reference/octahedral.h"
#include "tests/passes/reference/reprojection.h"

namespace walr::reference {
namespace {

/// What is farther, in units of depth, counts as this far.
constexpr double kFarthest = 3000.0;
/// Single precision may decide where two sides differ by less than this share.
constexpr double kClose = 1e-3;
/// The same of misses, which hold the rounding of kept motion.
constexpr double kCloseMiss = 0.01;
/// Misses of rays that both hit differ by rounding only.
constexpr double kRoundingOfMiss = 2e-5;
/// Pixels; either of two such places serves.
constexpr double kSamePlace = 0.01;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool close(double value, double threshold, double share = kClose) {
  return std::abs(value - threshold) <= share * std::abs(threshold);
}

/// A reflecting point, in the view space of its frame, with its shading normal.
struct Mirror {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};
  double roughness = 0.0;
};

/// Distances from the shortest to the longest.
struct Distances {
  double nearest = kInfinity;
  double farthest = 0.0;
  glm::ivec2 pixelOfNearest{0};
};

/// The stage at one pixel.
class Search {
 public:
  Search(const HostFrame& frame, const Image<Guide>& guides, const ReflectorHistory& previous,
         const TemporalAccumulationSettings& settings, const ReflectionMotionSettings& reflection, glm::ivec2 p)
      : frame_(frame), guides_(guides), previous_(previous), settings_(settings), reflection_(reflection), p_(p) {}

  Reflected find();

 private:
  [[nodiscard]] glm::dvec3 before(glm::dvec3 position) const {
    return glm::dvec3(glm::dmat4(frame_.constants.previousViewFromView) * glm::dvec4(position, 1.0));
  }
  [[nodiscard]] glm::dvec3 turned(glm::dvec3 direction) const {
    return glm::dmat3(glm::dmat4(frame_.constants.previousViewFromView)) * direction;
  }
  /// Where the previous picture shows a position, with its jitter.
  [[nodiscard]] glm::dvec2 shown(glm::dvec3 position) const {
    const glm::dvec4 ray(frame_.constants.previousRayFromPixel);
    return (glm::dvec2(position) / -position.z - glm::dvec2(ray.z, ray.w)) / glm::dvec2(ray);
  }
  [[nodiscard]] Mirror mirrorAt(glm::ivec2 q) const {
    return {rayThrough(frame_.constants.rayFromPixel, pixelCentre(q)) * guides_[q].depth,
            octahedralDecode(guides_[q].features), frame_.roughness[q]};
  }
  bool oneSurface(const Mirror& a, const Mirror& b) {
    const double cosine = glm::dot(a.normal, b.normal);
    const double distance = std::abs(glm::dot(b.position - a.position, a.normal + b.normal)) / -a.position.z;
    const double most = 2.0 * double(settings_.thresholds.planeTolerance);
    result_.undecided |= close(cosine, settings_.thresholds.normalThreshold) || close(distance, most);
    return cosine >= double(settings_.thresholds.normalThreshold) && distance <= most;
  }
  /// Whether a neighbour lies on the pixel's tangent plane and faces as it does.
  bool continues(const Mirror& own, glm::ivec2 offset) {
    const glm::ivec2 q = p_ + offset;
    if (!guides_.contains(q) || guides_[q].depth == 0.0) return false;
    const Mirror found = mirrorAt(q);
    const double cosine = glm::dot(own.normal, found.normal);
    const double distance = std::abs(glm::dot(found.position - own.position, own.normal)) / -own.position.z;
    const double most = settings_.thresholds.planeTolerance;
    result_.undecided |= close(cosine, settings_.thresholds.normalThreshold) || close(distance, most);
    return cosine >= double(settings_.thresholds.normalThreshold) && distance <= most;
  }
  /// Whether normals turn by less from pixel to pixel than view rays do. Beyond the border, the pixel there counts.
  bool isFlat() {
    const auto normalAt = [&](glm::ivec2 q) {
      return octahedralDecode(guides_[glm::clamp(q, glm::ivec2(0), guides_.size() - 1)].features);
    };
    const double across = glm::distance(normalAt(p_ + glm::ivec2(1, 0)), normalAt(p_ - glm::ivec2(1, 0)));
    const double down = glm::distance(normalAt(p_ + glm::ivec2(0, 1)), normalAt(p_ - glm::ivec2(0, 1)));
    const double most = 2.0 * std::abs(double(frame_.constants.rayFromPixel.y));
    result_.undecided |= close(std::max(across, down), most);
    return std::max(across, down) < most;
  }
  Distances distancesAround(const Mirror& own);
  /// Where the nearest point of those was, minus where it is, in view space.
  [[nodiscard]] glm::dvec3 motionOfReflected() const {
    const bool given = !frame_.specularMotion.pixels().empty() && frame_.roughness[p_] <= 0.25;
    if (!given || std::isinf(distances_.nearest)) return glm::dvec3(0.0);
    const glm::dvec3 moved = frame_.specularMotion[distances_.pixelOfNearest];
    if (!isFinite(moved)) return glm::dvec3(0.0);
    return glm::dmat3(glm::dmat4(frame_.constants.viewFromWorld)) * moved;
  }
  /// Whether a pixel of the previous frame shows what a mirror shows now.
  bool showsTheSame(glm::ivec2 q, double roughness);
  /// How far the surface was in the previous frame, where motion leads, over the depth that it would have there if it
  /// stood still, if that is to be found.
  double foundDepthChange(const Mirror& still, glm::dvec2 pixel);
  /// The mean of what the previous frame shows at a position; `whole`: all four pixels count.
  /// @param beyond  continues the bilinear mean by so many pixels
  std::optional<Mirror> shownAt(glm::dvec2 position, const Mirror& surface, bool& whole, glm::dvec2 beyond = {});
  [[nodiscard]] static glm::dvec3 miss(const Mirror& mirror, glm::dvec3 object) {
    const glm::dvec3 seen = glm::normalize(mirror.position);
    return glm::reflect(seen, glm::normalize(mirror.normal)) - glm::normalize(object - mirror.position);
  }

  const HostFrame& frame_;
  const Image<Guide>& guides_;
  const ReflectorHistory& previous_;
  const TemporalAccumulationSettings& settings_;
  const ReflectionMotionSettings& reflection_;
  glm::ivec2 p_;
  Distances distances_;  ///< Of the samples around.
  Reflected result_;
};

Distances Search::distancesAround(const Mirror& own) {
  Distances found;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      if (!continues(own, {x, y})) continue;
      const double d = frame_.lightAlpha[p_ + glm::ivec2(x, y)];
      if (!(d > 0.0)) continue;
      const double known = d < kLargestHalf ? std::max(d, -1e-3 * own.position.z) : kInfinity;
      if (known < found.nearest) found.pixelOfNearest = p_ + glm::ivec2(x, y);
      found.nearest = std::min(found.nearest, known);
      found.farthest = std::max(found.farthest, known);
    }
  }
  return found;
}

bool Search::showsTheSame(glm::ivec2 q, double roughness) {
  const double distance = previous_.distances[q];
  if (roughness > 0.05 || distances_.farthest == 0.0 || distance == 0.0) return true;
  // What is farther than 1,000 times the depth is at one distance.
  const double inverse = 1.0 / distance;
  const double least = 1e-3 / guides_[p_].depth;
  const double lowest = 1.0 / (1.25 * distances_.farthest) - least;
  const double highest = 1.25 / distances_.nearest + least;
  result_.undecided |= close(inverse, lowest) || close(inverse, highest);
  return inverse >= lowest && inverse <= highest;
}

double Search::foundDepthChange(const Mirror& still, glm::dvec2 pixel) {
  if (previous_.guides.pixels().empty() || !(glm::length(pixel) < 1e5)) return 1.0;
  constexpr double kRounding = 1e-5;  // Of a change, in single precision.
  std::vector<Measured> changes;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 q = glm::ivec2(glm::floor(pixel - 0.5)) + glm::ivec2(i % 2, i / 2);
    if (!previous_.guides.contains(q) || previous_.guides[q].depth == 0.0) continue;
    const glm::dvec3 normal = octahedralDecode(previous_.guides[q].features);
    const double cosine = glm::dot(still.normal, normal);
    result_.undecided |= close(cosine, settings_.thresholds.normalThreshold);
    const glm::dvec3 shown =
        rayThrough(frame_.constants.previousRayFromPixel, pixelCentre(q)) * previous_.guides[q].depth;
    const glm::dvec3 plane = still.normal + normal;
    changes.push_back({glm::dot(shown, plane) / glm::dot(still.position, plane), kRounding,
                       cosine >= double(settings_.thresholds.normalThreshold)});
  }
  const OwnValue change = nearestTap(changes, 1.0, settings_.thresholds.planeTolerance);
  result_.undecided |= change.undecided;
  return change.found ? change.value : 1.0;
}

std::optional<Mirror> Search::shownAt(glm::dvec2 position, const Mirror& surface, bool& whole, glm::dvec2 beyond) {
  whole = false;
  if (previous_.guides.pixels().empty() || !(glm::length(position) < 1e5)) return std::nullopt;
  const glm::dvec2 at = position - 0.5;
  const glm::dvec2 base = glm::floor(at);
  const glm::dvec2 f = at - base + beyond;
  Mirror sum;
  double weights = 0.0;
  int accepted = 0;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 q = glm::ivec2(base) + glm::ivec2(i % 2, i / 2);
    if (!previous_.guides.contains(q) || previous_.guides[q].depth == 0.0) continue;
    const Guide& guide = previous_.guides[q];
    const glm::dvec3 normal = octahedralDecode(guide.features);
    const Mirror tap{rayThrough(frame_.constants.previousRayFromPixel, pixelCentre(q)) * guide.depth, normal,
                     previous_.roughness[q]};
    if (!oneSurface(surface, tap) || std::abs(tap.roughness - surface.roughness) > 0.1) continue;
    if (!showsTheSame(q, surface.roughness)) continue;
    const double weight = (i % 2 == 1 ? f.x : 1.0 - f.x) * (i / 2 == 1 ? f.y : 1.0 - f.y);
    sum.position += weight * tap.position;
    sum.normal += weight * tap.normal;
    weights += weight;
    ++accepted;
  }
  result_.undecided |= weights < 0.02 && weights > 0.005;
  whole = accepted == 4;
  // Next to a pixel's centre, rounding may decide which pixels are the four; that matters where it rejects a part of
  // them.
  const glm::dvec2 toCentre = glm::min(at - base, 1.0 - at + base);
  result_.undecided |= !whole && accepted > 0 && std::min(toCentre.x, toCentre.y) < 0.02;
  if (weights <= 0.01) return std::nullopt;
  sum.position /= weights;
  sum.normal /= weights;
  return sum;
}

Reflected Search::find() {
  const Mirror own = mirrorAt(p_);
  const Reprojection r = reproject(frame_, guides_, p_, {.keepTaps = true});
  result_.undecided = r.undecided;
  result_.motion = r.pixel - pixelCentre(p_);
  result_.history = settings_.maxHistory;
  if (own.roughness >= double(reflection_.surfaceFrom)) return result_;

  const glm::dvec2 jitter(frame_.constants.jitterDelta);
  const glm::dvec2 surfaceAt = r.pixel + jitter;
  Mirror surface{r.position, turned(own.normal), own.roughness};
  if (r.findsDepth) surface.position *= foundDepthChange(surface, r.pixel);
  distances_ = distancesAround(own);
  const double distance = std::min(distances_.nearest, kFarthest * -own.position.z);
  const glm::dvec3 moved = motionOfReflected();
  const glm::dvec3 object =
      before(own.position + distance * glm::reflect(glm::normalize(own.position), own.normal) + moved);
  bool whole = false;
  const auto missAt = [&](glm::dvec2 position) {
    const auto there = shownAt(position, surface, whole);
    return there ? glm::length(miss(*there, object)) : kInfinity;
  };
  glm::dvec2 place = surfaceAt;
  if (own.roughness <= 0.1 && isFlat()) {
    const glm::dvec3 image = own.position + distance * glm::normalize(own.position) + glm::reflect(moved, own.normal);
    place += shown(before(image)) - shown(before(own.position));
  }
  double least = missAt(place);
  if (whole) {
    // Newton's method on the miss, with differences over a pixel.
    const auto beyond = [&](glm::dvec2 pixels) { return *shownAt(place, surface, whole, pixels); };
    const glm::dvec3 m = miss(beyond({}), object);
    const glm::dvec3 x = miss(beyond({1.0, 0.0}), object) - m;
    const glm::dvec3 y = miss(beyond({0.0, 1.0}), object) - m;
    const glm::dmat2 normal(glm::dot(x, x), glm::dot(x, y), glm::dot(x, y), glm::dot(y, y));
    const glm::dvec2 full = -glm::inverse(normal) * glm::dvec2(glm::dot(x, m), glm::dot(y, m));
    const glm::dvec2 step = full * std::min(1.0, 16.0 / glm::length(full));
    // By how much slopes of normals differ between the two sides of a square of pixels.
    const glm::dvec3 twist =
        beyond({}).normal - beyond({1.0, 0.0}).normal - beyond({0.0, 1.0}).normal + beyond({1.0, 1.0}).normal;
    const double uneven = (glm::length(twist) - 1e-4) * glm::dot(step, step);
    const bool either = std::abs(uneven - 0.5 * least) <= 0.5 * (kCloseMiss * least + kRoundingOfMiss);
    result_.undecided |= either && glm::length(step) > kSamePlace;
    if (uneven <= 0.5 * least) {
      place += step;
      least = glm::length(m + step.x * x + step.y * y);
    }
  }
  result_.followed = place != surfaceAt;
  if (result_.followed) result_.motion = place - jitter - pixelCentre(p_);
  const double lobe = 2.0 * std::atan(own.roughness * own.roughness);
  const double allowed = std::max(lobe, 0.5 * std::abs(double(frame_.constants.rayFromPixel.y)));
  result_.miss = least / allowed;
  result_.history = std::min(double(reflection_.historyPerLobe) / result_.miss, double(settings_.maxHistory));
  return result_;
}

}  // namespace

Image<Reflected> reflectionMotion(const HostFrame& frame, const Image<Guide>& guides, const ReflectorHistory& previous,
                                  const TemporalAccumulationSettings& settings,
                                  const ReflectionMotionSettings& reflection) {
  Image<Reflected> result(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (guides[p].depth > 0.0) result[p] = Search(frame, guides, previous, settings, reflection, p).find();
  });
  return result;
}

}  // namespace walr::reference
