#pragma once

#include "passes/temporal/reflection_motion.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// The motion of a pixel's reflected light to the previous frame (passes/SPECULAR.md).
struct Reflected {
  glm::dvec2 motion{0.0};  ///< Pixels.
  bool followed = false;   ///< It is not that of the surface.
  double history = 0.0;    ///< Longest history, frames; 0 without any.
  double miss = 0.0;       ///< Of the reflected ray, over the angle that is allowed.
  bool undecided = false;  ///< A decision lay so close to its threshold that rounding may decide.
};

/// What the previous frame showed.
struct ReflectorHistory {
  Image<Guide> guides;  ///< Empty while there is no history.
  Image<double> roughness;
  Image<double> distances;  ///< Of what mirrors reflect; 0 where unknown.
};

/// @param guides  as a device prepares them, with features of 16 bits
Image<Reflected> reflectionMotion(const HostFrame& frame, const Image<Guide>& guides, const ReflectorHistory& previous,
                                  const TemporalAccumulationSettings& settings,
                                  const ReflectionMotionSettings& reflection);

}  // namespace walr::reference
