#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "passes/conventions/frame.h"
#include "passes/conventions/inputs.h"
#include "passes/lint/lint_finding.h"
#include "passes/lint/lint_inputs.h"

namespace walr {

/// Finds errors in a host's inputs over any number of frames, from the counts of `addLintInputs` and from the cameras.
///
/// A wrong convention shows on most pixels, an accident of a scene on few. Another reading of the inputs is therefore
/// preferred to the stated one only if it explains more than half of the pixels that distinguish the two. Albedo in the
/// lighting is found from pairs of pixels with different albedo: on one surface both receive the same light on average.
/// So it is found only where surfaces have textures.
class InputLinter {
 public:
  explicit InputLinter(const InputConventions& conventions) : conventions_(conventions) {}

  /// Add a frame whose counts are known.
  /// @param words        words of the buffer that `addLintInputs` wrote
  /// @param afterAnother whether the history was not reset
  void add(std::span<const std::uint32_t> words, bool afterAnother) { counts_.add(words, afterAnother); }
  /// Look at a frame's two cameras, where the history was not reset.
  void add(const FrameDescription& frame, fg::Extent extent);

  /// What looks wrong so far; causes come before their possible consequences.
  [[nodiscard]] std::vector<LintFinding> findings() const;

 private:
  InputConventions conventions_;
  LintCounts counts_;
  std::uint64_t cameras_ = 0;
  std::uint64_t shiftedCameras_ = 0;  ///< Frames in which the projection's centre moved.
  glm::dvec2 largestShift_{0.0};      ///< Pixels.
};

}  // namespace walr
