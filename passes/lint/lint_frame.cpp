#include "passes/lint/lint_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace walr {
namespace {

glm::dvec3 rayThroughPixel(const glm::dvec4& rayFromPixel, glm::dvec2 pixel) {
  return {pixel * glm::dvec2(rayFromPixel) + glm::dvec2(rayFromPixel.z, rayFromPixel.w), -1.0};
}

/// Motion of a point between the images without jitter, and what of it motion holds.
glm::dvec2 motionTo(const LintReading& reading, glm::dvec2 pixel, const glm::dvec3& before) {
  const glm::dvec4& ray = reading.previousRay;
  const glm::dvec2 shown = (glm::dvec2(before) / -before.z - glm::dvec2(ray.z, ray.w)) / glm::dvec2(ray);
  return shown - pixel - reading.jitterDelta + reading.inMotion;
}

LintPrediction asGiven(const LintFrame& frame, const LintReading& reading, glm::dvec2 motion, double away) {
  LintPrediction seen{.motion = motion, .given = {}, .tolerance = {}, .away = away};
  // Rounding to halves is off by a two-thousandth, and a sample's place in its pixel by some hundredths.
  const double tolerance = 0.05 + 0.03 * glm::length(motion);
  for (int axis = 0; axis < 2; ++axis) {
    const double scale = reading.scale[axis];
    seen.given[axis] = scale == 0.0 ? 0.0 : motion[axis] / scale;
    // What is 0 is smaller than motion in any unit.
    seen.tolerance[axis] = tolerance / (scale == 0.0 ? frame.size[axis] : std::abs(scale));
  }
  return seen;
}

}  // namespace

glm::dvec3 LintFrame::rayThrough(glm::dvec2 pixel) const {
  return rayThroughPixel(glm::dvec4(constants.rayFromPixel), pixel);
}

glm::dmat4 viewFromView(const FrameDescription& from, const glm::dmat4& to, const glm::dvec3& toOrigin) {
  return to * glm::translate(glm::dmat4(1.0), from.origin - toOrigin) * glm::inverse(glm::dmat4(from.view));
}

LintReading statedReading(const LintFrame& frame, bool motionJittered) {
  const FrameDescription& camera = frame.camera;
  LintReading reading;
  reading.previousFromView = viewFromView(camera, glm::dmat4(camera.previousView), camera.previousOrigin);
  reading.previousRay = glm::dvec4(frame.constants.previousRayFromPixel);
  reading.jitterDelta = glm::dvec2(frame.constants.jitterDelta);
  if (motionJittered) reading.inMotion = reading.jitterDelta;
  return reading;
}

LintPrediction predict(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  const glm::dvec3 ray = frame.rayThrough(sample.pixel);
  const double depth = depthOf(frame, reading, sample);
  glm::dvec3 before(reading.previousFromView * glm::dvec4(ray * depth, 1.0));
  if (reading.depth == LintReading::Depth::Any) {
    const double nearness = std::max(inverseDepthFromMotion(frame, reading, sample), 0.0);
    before = glm::dmat3(reading.previousFromView) * ray + glm::dvec3(reading.previousFromView[3]) * nearness;
  }
  if (!(before.z < 0.0)) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    return {.motion = glm::dvec2(kFar), .given = glm::dvec2(kFar), .tolerance = glm::dvec2(1.0), .away = 0.0};
  }
  return asGiven(frame, reading, motionTo(reading, sample.pixel, before), -before.z - depth);
}

LintPrediction predict(const LintFrame& frame, const LintReading& reading, const LintReading& alike,
                       const LintPrediction& seenAlike) {
  if (std::isinf(seenAlike.motion.x)) return seenAlike;
  return asGiven(frame, reading, seenAlike.motion - alike.inMotion + reading.inMotion, seenAlike.away);
}

double depthOf(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  constexpr double kLeast = 1e-7;
  double depth = sample.depth;
  if (reading.depth == LintReading::Depth::Distance) depth /= glm::length(frame.rayThrough(sample.pixel));
  if (reading.depth == LintReading::Depth::Device) depth = 1.0 / std::max(1.0 - depth, kLeast);
  if (reading.depth == LintReading::Depth::Reversed) depth = 1.0 / std::max(depth, kLeast);
  return depth * reading.depthScale;
}

glm::dvec2 motionOfRotation(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  return motionTo(reading, sample.pixel, glm::dmat3(reading.previousFromView) * frame.rayThrough(sample.pixel));
}

double inverseDepthFromMotion(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  // The ray of the previous camera to which motion leads meets this camera's ray, turned and moved: their cross product
  // is 0, which is linear in inverse depth.
  const glm::dvec2 shown =
      sample.pixel + frame.motionOf(sample) * reading.scale + reading.jitterDelta - reading.inMotion;
  const glm::dvec3 target = rayThroughPixel(reading.previousRay, shown);
  const glm::dvec3 turned = glm::cross(target, glm::dmat3(reading.previousFromView) * frame.rayThrough(sample.pixel));
  const glm::dvec3 moved = glm::cross(target, glm::dvec3(reading.previousFromView[3]));
  const double square = glm::dot(moved, moved);
  return square > 0.0 ? -glm::dot(turned, moved) / square : 0.0;
}

}  // namespace walr
