#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "framegraph/declare/graph.h"
#include "passes/inputs.h"
#include "shaders/constants/lint.h"

namespace walr {

/// Add a pass that looks at a host's inputs and counts what is wrong with them, or would be right by another
/// convention. It changes nothing; `InputLinter` says in words what its counts mean.
/// @param counters of `kCounterBytes` (passes/inspection.h); overwritten
/// @returns its new version, whose words are those of shaders/constants/lint.h
fg::Buffer addLintInputs(fg::Graph& graph, const DenoiserInputs& inputs, fg::Buffer counters);

/// Counts of `addLintInputs`, summed over frames.
class LintCounts {
 public:
  /// Add a frame.
  /// @param words        of the buffer
  /// @param afterAnother whether a frame went before it, to which motion leads
  void add(std::span<const std::uint32_t> words, bool afterAnother);
  [[nodiscard]] std::uint64_t operator[](std::uint32_t word) const { return sums_[word]; }

 private:
  std::array<std::uint64_t, kLintWords> sums_{};
};

}  // namespace walr
