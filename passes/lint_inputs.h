#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "framegraph/declare/graph.h"
#include "passes/inputs.h"
#include "shaders/constants/lint.h"

namespace walr {

/// Add a pass that counts what is wrong in a host's inputs, and what another convention would explain. It changes
/// nothing; `InputLinter` turns the counts into text.
/// @param counters of `kCounterBytes` (passes/inspection.h); overwritten
/// @returns its new version, whose words are those of shaders/constants/lint.h
fg::Buffer addLintInputs(fg::Graph& graph, const DenoiserInputs& inputs, fg::Buffer counters);

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
