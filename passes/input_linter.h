#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "passes/frame.h"
#include "passes/inputs.h"
#include "passes/lint_finding.h"
#include "passes/lint_inputs.h"

namespace walr {

/// Judges a host's inputs over any number of frames, from what `addLintInputs` counts and from the cameras.
///
/// A wrong convention shows on most pixels and an accident of a scene on few, so that a reading of the inputs is only
/// preferred to the stated one where it explains more than half of the pixels that tell the two apart. Albedo in the
/// lighting is found by pairs of neighbours with unlike albedo: on one surface they get the same light on the mean.
class InputLinter {
 public:
  explicit InputLinter(const InputConventions& conventions) : conventions_(conventions) {}

  /// Add a frame whose counts are known.
  /// @param words        of the buffer that `addLintInputs` wrote
  /// @param afterAnother whether the history was not reset
  void add(std::span<const std::uint32_t> words, bool afterAnother) { counts_.add(words, afterAnother); }
  /// Look at a frame's two cameras, where the history was not reset.
  void add(const FrameDescription& frame, fg::Extent extent);

  /// What looks wrong so far, causes before what may follow from them.
  [[nodiscard]] std::vector<LintFinding> findings() const;

 private:
  InputConventions conventions_;
  LintCounts counts_;
  std::uint64_t cameras_ = 0;
  std::uint64_t shiftedCameras_ = 0;  ///< The projection's centre is not where it was.
  glm::dvec2 largestShift_{0.0};      ///< Pixels.
};

}  // namespace walr
