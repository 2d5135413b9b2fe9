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

/// The centre goes first: `merge` takes differences about it.
Moments mergeWindow(std::vector<WeightedMoments>& parts) {
  return merge(parts.data(), static_cast<int>(parts.size())).moments;
}

}  // namespace

Image<Moments> fullWindowMoments(const HostFrame& frame, const Image<Guide>& guides,
                                 const Image<glm::dvec4>& accumulated, int window,
                                 const WeightedRegressionSettings& settings) {
  const Image<Moments> samples = sampleMoments(guides, accumulated).moments;
  Image<Moments> result(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    std::vector<WeightedMoments> parts{{samples[p], 1.0, 0.0, {}}};
    forEachWindowPixel(guides.size(), p, window, [&](glm::ivec2 q) {
      if (q == p) return;
      const double weight = traceLine(frame, guides, p, q, settings);
      if (weight <= 0.0) return;
      parts.push_back({samples[q], weight * facing(guides[p], guides[q], settings), 0.0, {}});
    });
    result[p] = mergeWindow(parts);
  });
  return result;
}

Image<glm::dvec3> fullWindowRegression(const HostFrame& frame, const Image<Guide>& guides,
                                       const Image<glm::dvec4>& accumulated, int window,
                                       const WeightedRegressionSettings& settings) {
  const Image<Moments> moments = fullWindowMoments(frame, guides, accumulated, window, settings);
  Image<glm::dvec3> filtered(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    filtered[p] = guides[p].depth == 0.0 ? glm::dvec3(accumulated[p])
                                         : reconstruct(moments[p], guides[p].features, settings).colour;
  });
  return filtered;
}

Moments boxMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated, glm::ivec2 centre, int window) {
  const Image<Moments> samples = sampleMoments(guides, accumulated).moments;
  std::vector<WeightedMoments> parts{{samples[centre], 1.0, 0.0, {}}};
  forEachWindowPixel(guides.size(), centre, window, [&](glm::ivec2 q) {
    if (q != centre) parts.push_back({samples[q], 1.0, 0.0, {}});
  });
  return mergeWindow(parts);
}

}  // namespace walr::reference
