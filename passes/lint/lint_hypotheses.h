#pragma once

#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "passes/lint/lint_frame.h"

namespace walr {

/// A frame, and what the linter knows of the frames beside it.
struct LintContext {
  const LintFrame& frame;
  const LintFrame* last = nullptr;  ///< Null if there is none.
  const LintFrame* next = nullptr;  ///< Only with `LintHypothesis::needsNext`.
  bool motionJittered = true;
};

/// A mistake that hosts make, as another reading of motion, depth and cameras.
struct LintHypothesis {
  std::string_view name;  ///< Of the finding; for signs and units of motion without the axis: "motion-unit".
  std::string_view cause;
  std::string_view wayOut;
  /// Change the stated reading to that of the mistake.
  /// @param signs the mistake's
  /// @returns false if the frame cannot be read so
  bool (*apply)(const LintContext& context, const glm::dvec3& signs, LintReading& reading);
  glm::dvec3 signs{1.0};    ///< Of the axes of motion (0: missing) or of view space.
  bool needsNext = false;   ///< `apply` needs the next frame.
  bool fitsStated = false;  ///< It holds wherever the stated reading does.
  bool ofPlaces = false;    ///< It reads other positions from depth, of which motion.z and normals tell nothing.
  bool fits = false;  ///< `apply` fits numbers to samples: only for frames that the stated reading does not explain.
  std::string_view factorOf = {};  ///< What `LintReading::fitted` multiplies, for the finding.
  bool alternates = false;         ///< What motion holds sums up to little over frames, as jitter does.
};

/// All mistakes. Of two that explain the same, the first one is likelier.
const std::vector<LintHypothesis>& lintHypotheses();

}  // namespace walr
