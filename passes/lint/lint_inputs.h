#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "shaders/lint/lint_inputs.h"

namespace walr {

/// Add a pass that counts what is wrong in a host's inputs, and what another convention would explain. It changes
/// nothing; `InputLinter` turns the counts into text.
/// @param counters of `kCounterBytes` (passes/stage/inspection.h); overwritten
/// @returns its new version, whose words are those of shaders/lint/lint_inputs.h
fg::Buffer addLintInputs(fg::Graph& graph, const DenoiserInputs& inputs, fg::Buffer counters);

/// A count of `addLintInputs` that programs may want.
struct LintCount {
  std::string_view name;
  std::uint32_t word;  ///< Of the buffer.
};
inline constexpr std::array kLintCounts{
    LintCount{"lint-pixels", kLintPixels},
    LintCount{"lint-surfaces", kLintSurfaces},
    LintCount{"lint-diffuse", kLintDiffuse},
    LintCount{"lint-depth-not-finite", kLintDepthNotFinite},
    LintCount{"lint-depth-negative", kLintDepthNegative},
    LintCount{"lint-depth-zero", kLintDepthZero},
    LintCount{"lint-normal-not-finite", kLintNormalNotFinite},
    LintCount{"lint-normal-zero", kLintNormalZero},
    LintCount{"lint-normal-not-unit", kLintNormalNotUnit},
    LintCount{"lint-normal-tested", kLintNormalTested},
    LintCount{"lint-normal-fits", kLintNormalFits},
    LintCount{"lint-motion-not-finite", kLintMotionNotFinite},
    LintCount{"lint-motion-x-tested", kLintMotionX + kReadingTested},
    LintCount{"lint-motion-x-as-stated", kLintMotionX + kReadingAsStated},
    LintCount{"lint-motion-y-tested", kLintMotionY + kReadingTested},
    LintCount{"lint-motion-y-as-stated", kLintMotionY + kReadingAsStated},
    LintCount{"lint-motion-z-tested", kLintMotionZ + kReadingTested},
    LintCount{"lint-motion-z-as-stated", kLintMotionZ + kReadingAsStated},
    LintCount{"lint-lighting-not-finite", kLintLightingNotFinite},
    LintCount{"lint-lighting-negative", kLintLightingNegative},
    LintCount{"lint-lighting-samples", kLintSamples},
    LintCount{"lint-lighting-count-invalid", kLintCountInvalid},
    LintCount{"lint-albedo-not-finite", kLintAlbedoNotFinite},
    LintCount{"lint-albedo-outside", kLintAlbedoOutside},
};

/// Counts of `addLintInputs`, summed over frames.
class LintCounts {
 public:
  /// Add a frame.
  /// @param words        words of the buffer
  /// @param afterAnother whether motion leads to a previous frame
  void add(std::span<const std::uint32_t> words, bool afterAnother);
  [[nodiscard]] std::uint64_t operator[](std::uint32_t word) const { return sums_[word]; }

 private:
  std::array<std::uint64_t, kLintWords> sums_{};
};

}  // namespace walr
