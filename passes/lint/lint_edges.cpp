#include "passes/lint/lint_edges.h"

#include <algorithm>
#include <cmath>

namespace walr {

void LintEdges::add(const LintFrame& frame) {
  const auto isSurface = [&](double depth) { return depth > 0.0 && depth < frame.camera.skyDepth; };
  for (const LintSample& sample : frame.samples) {
    for (std::size_t i = 0; i < sample.around.size(); i += 2) {
      const auto [near, far] = std::minmax(sample.around.at(i), sample.around.at(i + 1));
      if (isSurface(near) && isSurface(far)) add(near, sample.depth, far);
    }
  }
}

void LintEdges::add(double near, double here, double far) {
  if (far < 3.0 * near) return;
  // On a plane, inverse depth is linear in the image.
  const double bend = std::abs(2.0 / here - 1.0 / near - 1.0 / far) * near / (1.0 - near / far);
  if (bend < 0.4) return;
  ++edges_;
  const double place = (here - near) / (far - near);
  between_ += place > 0.2 && place < 0.8 ? 1 : 0;
}

}  // namespace walr
