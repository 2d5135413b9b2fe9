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

/// The matrix whose product with a vector is the cross product of `a` and the vector.
glm::dmat3 crossMatrix(const glm::dvec3& a) {
  return {glm::dvec3(0.0, a.z, -a.y), glm::dvec3(-a.z, 0.0, a.x), glm::dvec3(a.y, -a.x, 0.0)};
}

/// The ray of the previous camera to which motion leads. It meets this camera's ray, turned and moved: their cross
/// product is 0, which is linear in inverse depth and in the translation.
glm::dvec3 targetOf(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  const glm::dvec2 shown =
      sample.pixel + frame.motionOf(sample) * reading.scale + reading.jitterDelta - reading.inMotion;
  return rayThroughPixel(reading.previousRay, shown);
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
  reading.ray = glm::dvec4(frame.constants.rayFromPixel);
  reading.previousRay = glm::dvec4(frame.constants.previousRayFromPixel);
  reading.jitterDelta = glm::dvec2(frame.constants.jitterDelta);
  if (motionJittered) reading.inMotion = reading.jitterDelta;
  return reading;
}

LintPrediction predict(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  const glm::dvec3 ray = rayThroughPixel(reading.ray, sample.pixel);
  const double depth = depthOf(reading, sample);
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

double depthOf(const LintReading& reading, const LintSample& sample) {
  constexpr double kLeast = 1e-7;
  double depth = sample.depth;
  if (reading.depth == LintReading::Depth::Distance) depth /= glm::length(rayThroughPixel(reading.ray, sample.pixel));
  if (reading.depth == LintReading::Depth::Device) depth = 1.0 / std::max(1.0 - depth, kLeast);
  if (reading.depth == LintReading::Depth::Reversed) depth = 1.0 / std::max(depth, kLeast);
  return depth * reading.depthScale;
}

glm::dvec2 motionOfRotation(const LintReading& reading, const LintSample& sample) {
  return motionTo(reading, sample.pixel,
                  glm::dmat3(reading.previousFromView) * rayThroughPixel(reading.ray, sample.pixel));
}

double inverseDepthFromMotion(const LintFrame& frame, const LintReading& reading, const LintSample& sample) {
  const glm::dvec3 target = targetOf(frame, reading, sample);
  const glm::dvec3 turned =
      glm::cross(target, glm::dmat3(reading.previousFromView) * rayThroughPixel(reading.ray, sample.pixel));
  const glm::dvec3 moved = glm::cross(target, glm::dvec3(reading.previousFromView[3]));
  const double square = glm::dot(moved, moved);
  return square > 0.0 ? -glm::dot(turned, moved) / square : 0.0;
}

glm::dvec3 translationFromMotion(const LintFrame& frame, const LintReading& reading) {
  // Least squares, each time with less weight on samples that are farther off than half a pixel.
  const double pixel = std::abs(reading.ray.x);
  const glm::dmat3 turn(reading.previousFromView);
  glm::dvec3 translation(0.0);
  for (int round = 0; round < 4; ++round) {
    glm::dmat3 squares(0.0);
    glm::dvec3 sums(0.0);
    for (const LintSample& sample : frame.samples) {
      const glm::dvec3 target = targetOf(frame, reading, sample);
      const double nearness = 1.0 / depthOf(reading, sample);
      const glm::dvec3 turned = glm::cross(target, turn * rayThroughPixel(reading.ray, sample.pixel));
      const glm::dmat3 moves = nearness * crossMatrix(target);
      const double off = glm::length(turned + moves * translation) / (0.5 * pixel);
      const double weight = round == 0 ? 1.0 : 1.0 / (1.0 + off * off * off * off);
      if (!std::isfinite(weight)) continue;
      squares += weight * (glm::transpose(moves) * moves);
      sums -= weight * (glm::transpose(moves) * turned);
    }
    translation = glm::inverse(squares) * sums;
  }
  return translation;
}

}  // namespace walr
