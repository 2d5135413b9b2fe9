#include "tests/passes/reference/edge_tracing.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::reference {

glm::dvec3 planeNormal(const Guide& guide, const EdgeStoppingSettings& settings) {
  return settings.planeNormal == PlaneNormal::Geometric ? guide.normal : octahedralDecode(guide.features);
}

double facing(const Guide& a, const Guide& b, const EdgeStoppingSettings& settings) {
  if (!settings.normalFactor) return 1.0;
  return std::clamp(glm::dot(planeNormal(a, settings), planeNormal(b, settings)), 0.0, 1.0);
}

EdgeWeight edgeWeight(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                      const EdgeStoppingSettings& settings) {
  if (!guides.contains(q) || guides[q].depth == 0.0) return {};
  const Guide& centre = guides[p];
  const glm::dvec3 centreRay = rayThrough(frame.constants.rayFromPixel, pixelCentre(p));
  const glm::dvec3 ray = rayThrough(frame.constants.rayFromPixel, pixelCentre(q));
  const double ratio = guides[q].depth / centre.depth;
  // dot(n, position - centre) / depth of the centre.
  const double distance = std::abs(glm::dot(planeNormal(centre, settings), ratio * ray - centreRay));
  // About twelve roundings, of the normal's decoding, the rays, the ratio and the products. Each term is no larger than
  // the two positions in units of the centre's depth.
  const double distanceError = 12.0 * kFloatRoundoff * (ratio * glm::length(ray) + glm::length(centreRay));
  const auto planeNear = double(settings.planeNear);
  const auto planeFar = double(settings.planeFar);
  const double range = planeFar - planeNear;
  EdgeWeight result;
  result.weight = std::clamp((planeFar - distance) / range, 0.0, 1.0);
  result.undecided = std::abs(distance - planeFar) <= distanceError;
  const bool onRamp = distance > planeNear - distanceError && distance < planeFar + distanceError;
  result.error = onRamp ? distanceError / range : 0.0;
  return result;
}

Trace traceEdge(const HostFrame& frame, const Image<Guide>& guides, const Image<int>& distances, glm::ivec2 p,
                glm::ivec2 direction, int steps, const WeightedRegressionSettings& settings) {
  const auto distanceAt = [&](glm::ivec2 q) { return distances.contains(q) ? distances[q] : 0; };
  Trace trace;
  trace.edge = steps + 1;
  int step = 0;
  while (step < steps) {
    const int stride = static_cast<int>(std::floor(double(settings.sdfFraction) * distanceAt(p + step * direction)));
    step = settings.traceEdges ? std::min(step + std::max(stride, 1), steps) : steps;
    const EdgeWeight here = edgeWeight(frame, guides, p, p + step * direction, settings.edgeStopping);
    trace.weight.weight = std::min(trace.weight.weight, here.weight);
    trace.weight.error = std::max(trace.weight.error, here.error);
    trace.weight.undecided |= here.undecided;
    if (here.weight <= 0.0) {
      trace.edge = step;
      break;
    }
  }
  return trace;
}

EdgeWeight traceLine(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                     const EdgeStoppingSettings& settings) {
  const glm::ivec2 offset = q - p;
  const int steps = std::max(std::abs(offset.x), std::abs(offset.y));
  EdgeWeight result{1.0, 0.0, false};
  for (int step = 1; step <= steps; ++step) {
    const glm::ivec2 at(std::lround(double(offset.x) * step / steps), std::lround(double(offset.y) * step / steps));
    const EdgeWeight here = edgeWeight(frame, guides, p, p + at, settings);
    if (here.weight == 0.0 && here.error == 0.0) return {};
    result.weight = std::min(result.weight, here.weight);
    result.error = std::max(result.error, here.error);
    result.undecided |= here.undecided;
  }
  return result;
}

}  // namespace walr::reference
