#pragma once

#include <cstdint>

#include "passes/lint/lint_frame.h"

namespace walr {

/// Depth across edges: a pixel is on one surface or the other, not between them.
class LintEdges {
 public:
  void add(const LintFrame& frame);

  /// Samples with an edge across them: on one side depth is more than three times that on the other, and no plane
  /// explains it.
  [[nodiscard]] std::uint64_t edges() const { return edges_; }
  /// Edges on which the sample's depth lies between both.
  [[nodiscard]] std::uint64_t between() const { return between_; }

 private:
  void add(double near, double here, double far);

  std::uint64_t edges_ = 0;
  std::uint64_t between_ = 0;
};

}  // namespace walr
