#include "tests/passes/reference/reprojection.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/passes/reference/storage.h"

namespace walr::reference {
namespace {

double exactDepth(double depth) {
  return depth;
}
/// Rounded down to 12 significant bits.
double shortDepth(double depth) {
  int exponent = 0;
  const double mantissa = std::frexp(depth, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, 12)), exponent - 12);
}

/// Motion vector dilation (Meunier & Harada 2022, 4.2): the pixel of the 3x3 neighbourhood whose surface is nearest to
/// the camera. Among equally near ones the pixel itself comes first, then reading order.
/// @param rounded how depths are rounded before they are compared
glm::ivec2 nearestPixel(const Image<Guide>& guides, glm::ivec2 p, double (*rounded)(double)) {
  glm::ivec2 nearest = p;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const glm::ivec2 q = p + glm::ivec2(dx, dy);
      if (!guides.contains(q) || guides[q].depth == 0.0) continue;
      if (rounded(guides[q].depth) < rounded(guides[nearest].depth)) nearest = q;
    }
  }
  return nearest;
}

/// The motion that the texture of history taps holds: a half with the two lowest bits of its mantissa cleared, rounded
/// to nearest, ties to even; 0 below the normal halves.
double keptMotion(double motion) {
  if (std::abs(motion) < 0x1p-14) return 0.0;
  int exponent = 0;
  (void)std::frexp(motion, &exponent);
  return std::clamp(std::ldexp(std::nearbyint(std::ldexp(motion, 9 - exponent)), exponent - 9), -32768.0, 32768.0);
}

}  // namespace

glm::ivec2 followedPixel(const Image<Guide>& guides, glm::ivec2 p, const ReprojectionOptions& options) {
  if (options.dilateByShortDepth) return nearestPixel(guides, p, shortDepth);
  return options.dilateMotion ? nearestPixel(guides, p, exactDepth) : p;
}

Reprojection reproject(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p,
                       const ReprojectionOptions& options) {
  const FrameConstants& constants = frame.constants;
  const glm::ivec2 source = followedPixel(guides, p, options);
  const glm::dmat4 previousFromCurrent(constants.previousViewFromView);
  const auto positionBefore = [&](glm::ivec2 q) {
    const glm::dvec3 position = rayThrough(constants.rayFromPixel, pixelCentre(q)) * guides[q].depth;
    return glm::dvec3(previousFromCurrent * glm::dvec4(position, 1.0));
  };
  const bool fromCamera = !frame.scene.objectMotion;
  glm::dvec2 motion = glm::dvec2(frame.motion[source]) * glm::dvec2(constants.motionScale);
  if (fromCamera) {
    const glm::dvec3 before = positionBefore(source);
    const glm::dvec4 ray(constants.previousRayFromPixel);
    motion = (glm::dvec2(before) / -before.z - glm::dvec2(ray.z, ray.w)) / glm::dvec2(ray) - pixelCentre(source);
  }
  Reprojection r;
  for (int axis = 0; axis < 2; ++axis) {
    const double product = motion[axis];
    const bool jittered = frame.scene.jitter && (fromCamera || frame.conventions.motionJittered);
    const auto jitter = jittered ? double(constants.jitterDelta[axis]) : 0.0;
    motion[axis] = product - jitter;
    if (!options.keepTaps) continue;
    // Single precision rounds both operations, or only the result where the compiler contracts them to one.
    const double apart = keptMotion(roundToFloat(roundToFloat(product) - jitter));
    const double contracted = keptMotion(roundToFloat(product - jitter));
    r.undecided |= apart != contracted;
    motion[axis] = apart;
  }
  const glm::dvec2 there = pixelCentre(p) + motion;  // In pixels of the current image.
  const glm::dvec2 scale(constants.previousPixelFromPixel);
  r.pixel = there * scale;
  // Motion from a vector: product, sum and difference, each no larger than result, start and motion.
  // Motion from the camera: about twelve roundings of a position and its projection, in pixels of the previous image.
  const double reach = 2.0 * std::max({std::abs(r.pixel.x), std::abs(r.pixel.y), 1.0}) + 1.0;
  const double across = double(std::max(frame.size().x, frame.size().y));
  r.error = fromCamera ? 24.0 * kFloatRoundoff * std::max(reach, across) : 4.0 * kFloatRoundoff * reach;
  // If the previous image has another size, the sum is rounded before it is scaled and may be the larger one. The
  // product and half a pixel each way round too.
  if (scale != glm::dvec2(1.0)) {
    r.error *= std::max({scale.x, scale.y, 1.0});
    r.error += 4.0 * kFloatRoundoff * reach;
  }
  double previousDepth = guides[p].depth + frame.motion[p].z;
  if (fromCamera || frame.conventions.motionDepth != InputConventions::MotionDepth::Given) {
    previousDepth = -positionBefore(p).z;
  }
  // Of the sample, which jitter displaces.
  r.position = rayThrough(constants.previousRayFromPixel, there + glm::dvec2(constants.jitterDelta)) * previousDepth;
  r.normal = glm::dmat3(previousFromCurrent) * guides[p].normal;
  r.object = guides[p].object;
  r.findsDepth = !fromCamera && frame.conventions.motionDepth == InputConventions::MotionDepth::Found;
  const glm::dvec2 size(frame.size());
  r.valid = there.x > -1.0 && there.y > -1.0 && there.x < size.x + 1.0 && there.y < size.y + 1.0 &&
            std::isfinite(previousDepth) && previousDepth > 0.0;
  return r;
}

OwnValue nearestTap(std::span<const Measured> taps, double still, double tolerance) {
  constexpr double kMostDepthChange = 0.1;
  const double most = std::max(kMostDepthChange * std::abs(still), tolerance);
  OwnValue nearest{.found = false};
  double least = most;
  for (const Measured& tap : taps) {
    const double distance = std::abs(tap.value - still);
    if (!tap.candidate) continue;
    nearest.undecided |= std::abs(distance - most) <= tap.error;
    if (distance > least) continue;
    nearest = {.value = tap.value, .found = true, .undecided = nearest.undecided};
    least = distance;
  }
  // Of two taps equally near, on either side, rounding decides.
  for (const Measured& tap : taps) {
    const bool other = tap.candidate && std::abs(tap.value - nearest.value) > 2.0 * tap.error;
    nearest.undecided |= nearest.found && other && std::abs(tap.value - still) <= least + 2.0 * tap.error;
  }
  return nearest;
}

std::array<HistoryTap, 4> historyTaps(const HostFrame& frame, const Reprojection& r, const Image<Guide>& previousGuides,
                                      const HistoryTests& tests, const TapGrid& grid) {
  std::array<HistoryTap, 4> taps;
  if (!r.valid) return taps;
  const glm::dvec2 position = (r.pixel - 0.5 - glm::dvec2(grid.first)) / glm::dvec2(grid.spacing);
  const glm::dvec2 base = glm::floor(position);
  const glm::dvec2 f = position - base;
  const bool byPlane = tests.rejection == HistoryRejection::Plane;
  const auto valueOf = [&](glm::dvec3 position) { return byPlane ? glm::dot(r.normal, position) : -position.z; };
  std::array<Measured, 4> measured;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 offset(i % 2, i / 2);
    HistoryTap& tap = taps[i];
    tap.pixel = (glm::ivec2(base) + offset) * grid.spacing + grid.first;
    tap.weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
    tap.undecided = r.undecided;
    if (!previousGuides.contains(tap.pixel) || previousGuides[tap.pixel].depth == 0.0) continue;
    if (tests.objects && (r.object == 0 || previousGuides[tap.pixel].object != r.object)) continue;
    tap.matches = true;
    if (tests.rejection == HistoryRejection::None) continue;
    const Guide& guide = previousGuides[tap.pixel];
    const glm::dvec2 pixel = pixelCentre(tap.pixel) * glm::dvec2(frame.constants.pixelFromPreviousPixel);
    const glm::dvec3 position = rayThrough(frame.constants.previousRayFromPixel, pixel) * guide.depth;
    measured[i].value = valueOf(position);
    // About sixteen roundings, of terms no larger than the two positions and of unit vectors.
    measured[i].error = 16.0 * kFloatRoundoff * (glm::length(position) + glm::length(r.position)) +
                        r.error * std::abs(r.position.z) *
                            std::max(std::abs(double(frame.constants.previousRayFromPixel.x)),
                                     std::abs(double(frame.constants.previousRayFromPixel.y)));
    if (byPlane) {
      const double cosine = glm::dot(r.normal, guide.normal);
      tap.matches = cosine >= tests.normalThreshold;
      tap.undecided |= std::abs(cosine - tests.normalThreshold) <= 32.0 * kFloatRoundoff;
    }
    measured[i].candidate = tap.matches;
  }
  if (tests.rejection == HistoryRejection::None) return taps;
  const double tolerance = tests.planeTolerance * -r.position.z;
  OwnValue surface{.value = valueOf(r.position)};
  if (r.findsDepth) {
    // Whether a tap is a candidate decides for the others, too.
    const bool undecided = std::ranges::any_of(taps, &HistoryTap::undecided);
    surface = nearestTap(measured, surface.value, tolerance);
    for (HistoryTap& tap : taps) tap.undecided |= undecided || surface.undecided;
  }
  for (int i = 0; i < 4; ++i) {
    if (!taps[i].matches && !taps[i].undecided) continue;
    const double distance = std::abs(measured[i].value - surface.value);
    taps[i].matches = taps[i].matches && surface.found && distance <= tolerance;
    taps[i].undecided |= surface.found && std::abs(distance - tolerance) <= measured[i].error;
  }
  return taps;
}

}  // namespace walr::reference
