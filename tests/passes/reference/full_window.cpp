#include "tests/passes/reference/full_window.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace walr::reference {
namespace {

template <typename Visit>
void forEachWindowPixel(glm::ivec2 size, glm::ivec2 centre, int window, Visit visit) {
  const int radius = window / 2;
  const glm::ivec2 first = glm::max(centre - radius, glm::ivec2(0));
  const glm::ivec2 last = glm::min(centre + radius, size - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) visit(glm::ivec2(x, y));
}

}  // namespace

Image<WindowPixel> fullWindowRegression(const HostFrame& frame, const Image<Guide>& guides,
                                        const Image<glm::dvec4>& accumulated, const FullWindowSettings& settings) {
  const Image<Moments> samples = sampleMoments(guides, accumulated).moments;
  const auto window = static_cast<int>(settings.window);
  Image<WindowPixel> result(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    WindowPixel& pixel = result[p];
    if (guides[p].depth == 0.0) {
      pixel.fitted.colour = glm::dvec3(accumulated[p]);
      return;
    }
    std::vector<WeightedMoments> parts{{samples[p], 1.0, 0.0, sampleError(samples[p])}};
    forEachWindowPixel(guides.size(), p, window, [&](glm::ivec2 q) {
      if (q == p) return;
      const EdgeWeight traced = traceLine(frame, guides, p, q, settings.edgeStopping);
      if (traced.weight == 0.0 && traced.error == 0.0) return;
      // The factor's own error: decoding and multiplying two unit vectors.
      parts.push_back({samples[q], traced.weight * facing(guides[p], guides[q], settings.edgeStopping),
                       traced.error + 16.0 * kFloatRoundoff, sampleError(samples[q])});
    });
    // Rows are summed first, then their sums.
    pixel.merged = merge(parts.data(), static_cast<int>(parts.size()), 2 * window);
    pixel.undecided = pixel.merged.error[kMomentCount - 1] > 0.5 * pixel.merged.moments.samples;
    pixel.fitted = reconstruct(pixel.merged.moments, guides[p].features, settings.regularisation, pixel.merged.error);
  });
  return result;
}

Moments boxMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated, glm::ivec2 centre, int window) {
  const Image<Moments> samples = sampleMoments(guides, accumulated).moments;
  std::vector<WeightedMoments> parts{{samples[centre], 1.0, 0.0, {}}};
  forEachWindowPixel(guides.size(), centre, window, [&](glm::ivec2 q) {
    if (q != centre) parts.push_back({samples[q], 1.0, 0.0, {}});
  });
  return merge(parts.data(), static_cast<int>(parts.size())).moments;
}

}  // namespace walr::reference
