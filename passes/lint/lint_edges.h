#pragma once

#include <cstdint>

#include "passes/lint/lint_frame.h"

namespace walr {

/// Depth across edges: a pixel is on one surface or the other, not between them.
class LintEdges {
 public:
  void add(const LintFrame& frame);

  /// Places where depth grows to more than three times from one neighbour of a sample to the opposite one, which no
  /// plane explains, and those of them where the sample lies between both.
  [[nodiscard]] std::uint64_t edges() const { return edges_; }
  [[nodiscard]] std::uint64_t between() const { return between_; }

 private:
  void add(double near, double here, double far);

  std::uint64_t edges_ = 0;
  std::uint64_t between_ = 0;
};

}  // namespace walr
