#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "tests/passes/reference/frame.h"
#include "tests/passes/reference/guides.h"
#include "tests/passes/synthetic_scene.h"

/// Flat and spherical mirrors, and where exactly they show things in two frames.
namespace walr::test {

inline constexpr glm::ivec2 kMirrorSize(64, 48);
/// Pixels per unit of slope: those of a picture of 1080 lines that is 0.8 radians high.
inline const double kPixels = 540.0 / std::tan(0.4);
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A spherical mirror that meets (0, 0, -distance) with a normal that is `tilt` away from the z axis.
struct Mirror {
  double radius = 0.0;  ///< Above 0: convex; below 0: concave; infinite: flat.
  double tilt = 0.0;    ///< Radians.
  double distance = 2.0;
  glm::dvec3 moved{0.0};   ///< Since the previous frame.
  glm::dvec3 offset{0.0};  ///< Of the mirror from that place.

  /// The mirror of the previous frame.
  [[nodiscard]] Mirror before() const { return {radius, tilt, distance, {}, offset - moved}; }
  [[nodiscard]] glm::dvec3 point() const { return glm::dvec3(0.0, 0.0, -distance) + offset; }
  [[nodiscard]] glm::dvec3 axis() const { return {0.8 * std::sin(tilt), 0.6 * std::sin(tilt), std::cos(tilt)}; }
  [[nodiscard]] bool flat() const { return std::isinf(radius); }
  [[nodiscard]] glm::dvec3 centre() const { return point() - radius * axis(); }
  [[nodiscard]] glm::dvec3 normalAt(glm::dvec3 q) const { return flat() ? axis() : (q - centre()) / radius; }

  /// Distance along a ray; of two, that of the hit nearer to `point`.
  [[nodiscard]] std::optional<double> hit(glm::dvec3 origin, glm::dvec3 direction) const {
    if (flat()) return glm::dot(point() - origin, axis()) / glm::dot(direction, axis());
    const glm::dvec3 from = origin - centre();
    const double a = glm::dot(direction, direction);
    const double b = glm::dot(from, direction);
    const double root = b * b - a * (glm::dot(from, from) - radius * radius);
    if (root < 0.0) return std::nullopt;
    const double near = (-b - std::sqrt(root)) / a;
    const double far = (-b + std::sqrt(root)) / a;
    const auto away = [&](double t) { return glm::distance(origin + t * direction, point()); };
    const double t = away(near) < away(far) ? near : far;
    return t > 0.0 ? std::optional(t) : std::nullopt;
  }
  [[nodiscard]] Scene scene() const {
    return [*this](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
      const auto t = hit(origin, direction);
      if (!t) return std::nullopt;
      return SceneHit{.distance = *t, .shadingNormal = normalAt(origin + *t * direction), .moved = moved};
    };
  }

  /// The point that reflects `object` into `eye`, near `start`: there, by Fermat's principle, the length of the way has
  /// no slope along the mirror.
  [[nodiscard]] std::optional<glm::dvec3> reflecting(glm::dvec3 eye, glm::dvec3 object, glm::dvec3 start) const {
    glm::dvec3 q = start;
    for (int i = 0; i < 50; ++i) {
      const glm::dvec3 n = normalAt(q);
      const glm::dvec3 t = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.5, 0.8)));
      const glm::dvec3 u = glm::cross(n, t);
      const auto at = [&](glm::dvec2 s) {
        const glm::dvec3 moved = q + s.x * t + s.y * u;
        return flat() ? moved : centre() + radius * glm::normalize((moved - centre()) / radius);
      };
      const auto slope = [&](glm::dvec2 s) {
        const glm::dvec3 p = at(s);
        const glm::dvec3 pull = glm::normalize(p - eye) + glm::normalize(p - object);
        const glm::dvec3 along = pull - glm::dot(pull, normalAt(p)) * normalAt(p);
        return glm::dvec2(glm::dot(along, t), glm::dot(along, u));
      };
      constexpr double kStep = 1e-6;
      const glm::dvec2 here = slope({});
      const glm::dmat2 jacobian((slope({kStep, 0.0}) - slope({-kStep, 0.0})) / (2.0 * kStep),
                                (slope({0.0, kStep}) - slope({0.0, -kStep})) / (2.0 * kStep));
      glm::dvec2 step = -glm::inverse(jacobian) * here;
      step *= std::min(1.0, 0.05 / std::max(glm::length(step), 1e-12));
      q = at(step);
      if (glm::length(step) < 1e-10) return q;
    }
    return std::nullopt;
  }
};

inline FrameDescription zoomed(FrameDescription camera) {
  const glm::dvec2 scale = 2.0 * kPixels / glm::dvec2(kMirrorSize);
  for (glm::mat4* projection : {&camera.projection, &camera.previousProjection}) {
    (*projection)[0][0] = static_cast<float>(scale.x);
    (*projection)[1][1] = static_cast<float>(scale.y);
  }
  return camera;
}

/// A frame of specular light. What is reflected lies at one distance from all pixels.
inline reference::HostFrame specularFrame(const Scene& scene, const FrameDescription& camera, double distance,
                                          double roughness) {
  const reference::HostFrame frame = renderFrame(scene, camera, kMirrorSize, smoothLight, Noise::None);
  return asSpecular(frame, distance, std::round(255.0 * roughness) / 255.0);
}

/// Figures of errors: their mean, and the largest of 99 in 100.
struct ErrorFigures {
  double mean = 0.0;
  double worst = 0.0;

  [[nodiscard]] std::string text() const { return std::to_string(mean) + " " + std::to_string(worst); }
};
inline ErrorFigures figuresOf(std::vector<double> errors) {
  std::ranges::sort(errors);
  double sum = 0.0;
  for (const double e : errors) sum += e;
  return {sum / static_cast<double>(errors.size()), errors[errors.size() * 99 / 100]};
}

/// Cameras of two frames, a few pixels of motion apart.
struct Walk {
  FrameDescription first;
  FrameDescription second;
};
inline Walk walk(glm::dvec3 step, bool jitter) {
  Walk cameras{zoomed(cameraAt(-step, -2.0 * step, kMirrorSize, 0)), zoomed(cameraAt({}, -step, kMirrorSize, 1))};
  if (jitter) cameras = {jittered(cameras.first, 3), jittered(cameras.second, 4)};
  return cameras;
}

/// The exact motion of what a pixel of the second frame reflects.
/// @param reflectedMotion  where that was, minus where it is
inline std::optional<glm::dvec2> exactMotion(const Mirror& mirror, const reference::HostFrame& frame, glm::dvec3 step,
                                             double distance, glm::ivec2 p, glm::dvec3 reflectedMotion = {}) {
  const glm::dvec3 ray = reference::rayThrough(frame.constants.rayFromPixel, reference::pixelCentre(p));
  const auto t = mirror.hit({}, ray);
  if (!t) return std::nullopt;
  const glm::dvec3 point = *t * ray;
  const glm::dvec3 object = point + distance * glm::reflect(glm::normalize(ray), mirror.normalAt(point));
  const auto q = mirror.before().reflecting(-step, object + reflectedMotion, point - mirror.moved);
  if (!q || glm::distance(*q, point) > 0.1) return std::nullopt;
  const glm::dvec3 seen = *q + step;
  const glm::dvec4 before(frame.constants.previousRayFromPixel);
  const glm::dvec2 shown = (glm::dvec2(seen) / -seen.z - glm::dvec2(before.z, before.w)) / glm::dvec2(before);
  return shown - glm::dvec2(frame.constants.jitterDelta) - reference::pixelCentre(p);
}

}  // namespace walr::test
