#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "passes/conventions/frame.h"
#include "passes/conventions/inputs.h"
#include "passes/lint/lint_edges.h"
#include "passes/lint/lint_finding.h"
#include "passes/lint/lint_inputs.h"
#include "passes/lint/lint_normals.h"
#include "passes/lint/lint_scores.h"

namespace walr {

/// Finds errors in a host's inputs over any number of frames, from what `addLintInputs` wrote and from the cameras.
///
/// A wrong convention shows on most pixels, an accident of a scene on few. Every mistake that hosts make is another
/// reading of motion, depth and cameras (`lintHypotheses`). The linter scores them all on samples of each frame, and
/// reports the one that explains motion best, if it explains it clearly better than the stated reading. Albedo in the
/// lighting is found from pairs of pixels with different albedo: on one surface both receive the same light on average.
/// So it is found only where surfaces have textures.
class InputLinter {
 public:
  explicit InputLinter(const InputConventions& conventions)
      : conventions_(conventions), normals_(conventions), motion_(conventions) {}

  /// Add the next frame.
  /// @param words     words of the buffer that `addLintInputs` wrote
  /// @param extent    the image's
  /// @param continues whether its history was not reset
  void add(std::span<const std::uint32_t> words, const FrameDescription& camera, fg::Extent extent, bool continues);

  /// What looks wrong so far; causes come before their possible consequences.
  [[nodiscard]] std::vector<LintFinding> findings() const;

 private:
  void addProjections(const FrameDescription& camera, fg::Extent extent);

  InputConventions conventions_;
  LintCounts counts_;
  LintEdges edges_;
  LintNormals normals_;
  LintMotion motion_;
  std::uint64_t cameras_ = 0;
  std::uint64_t shiftedCameras_ = 0;  ///< Frames in which the projection's centre moved.
  glm::dvec2 largestShift_{0.0};      ///< Pixels.
};

}  // namespace walr
