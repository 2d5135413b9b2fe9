#pragma once

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "passes/conventions/frame.h"
#include "passes/conventions/inputs.h"
#include "passes/lint/lint_inputs.h"

namespace walr {

/// A frame as the linter knows it.
struct LintFrame {
  FrameDescription camera;
  FrameConstants constants;  ///< Of `camera`.
  glm::dvec2 size;           ///< Pixels.
  bool continues = false;    ///< The host says that motion leads to the frame before.
  std::vector<LintSample> samples;

  [[nodiscard]] glm::dvec3 rayThrough(glm::dvec2 pixel) const;
  /// Motion of a sample as the host states it, pixels.
  [[nodiscard]] glm::dvec2 motionOf(const LintSample& sample) const {
    return glm::dvec2(sample.motion) * glm::dvec2(camera.motionScale);
  }
};

/// View space of a frame to that of another one, for still surfaces.
/// @param to, toOrigin the other one's view matrix and origin
glm::dmat4 viewFromView(const FrameDescription& from, const glm::dmat4& to, const glm::dvec3& toOrigin);

/// A way to read motion, depth and cameras together: the stated one, or that of a mistake.
struct LintReading {
  enum class Depth {
    Axis,      ///< Along the view axis.
    Distance,  ///< Along the ray.
    Device,    ///< Of a projection with a far plane far away.
    Reversed,  ///< Of a reversed one.
    Any,       ///< Unknown: that which agrees best with motion.
  };
  glm::dmat4 previousFromView{1.0};
  glm::dvec4 ray{0.0};          ///< As `FrameConstants::rayFromPixel`.
  glm::dvec4 previousRay{0.0};  ///< As `FrameConstants::previousRayFromPixel`.
  glm::dvec2 jitterDelta{0.0};  ///< As `FrameConstants::jitterDelta`.
  glm::dvec2 inMotion{0.0};     ///< Jitter that motion holds, pixels.
  glm::dvec2 scale{1.0};        ///< Multiplies motion to give pixels, beside the stated scale; 0: motion is 0.
  double depthScale = 1.0;      ///< Multiplies depth.
  Depth depth = Depth::Axis;
  glm::dvec2 fitted{1.0};  ///< Factors of x and y that were fitted to the samples.

  [[nodiscard]] bool samePlaces(const LintReading& other) const {
    return previousFromView == other.previousFromView && ray == other.ray && previousRay == other.previousRay &&
           jitterDelta == other.jitterDelta && depthScale == other.depthScale && depth == other.depth;
  }
};

/// The reading that the host states.
LintReading statedReading(const LintFrame& frame, bool motionJittered);

/// What a still surface shows under a reading.
struct LintPrediction {
  glm::dvec2 motion;     ///< Pixels.
  glm::dvec2 given;      ///< What the host would have handed over, in the stated unit.
  glm::dvec2 tolerance;  ///< Of `given`.
  double away;           ///< Previous minus current view depth.
};
/// Infinite motion where the surface lay behind the previous camera.
LintPrediction predict(const LintFrame& frame, const LintReading& reading, const LintSample& sample);
/// The same from what a reading of the same depth and cameras shows.
LintPrediction predict(const LintFrame& frame, const LintReading& reading, const LintReading& alike,
                       const LintPrediction& seenAlike);
/// View depth of a sample under a reading, scene units.
double depthOf(const LintReading& reading, const LintSample& sample);
/// Motion that the camera's rotation alone would give, pixels.
glm::dvec2 motionOfRotation(const LintReading& reading, const LintSample& sample);
/// Inverse of the view depth that agrees best with motion, scene units; below 0 behind the camera, 0 where the camera
/// does not move.
double inverseDepthFromMotion(const LintFrame& frame, const LintReading& reading, const LintSample& sample);
/// Translation from this frame's view space to the previous one's that agrees best with the motion of most samples, for
/// a reading's rotation and depth; not finite if none does.
glm::dvec3 translationFromMotion(const LintFrame& frame, const LintReading& reading);

}  // namespace walr
