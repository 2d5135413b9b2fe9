#pragma once

#include "passes/weighted_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A weight, and what single precision may do to it.
struct EdgeWeight {
  double weight = 0.0;
  double error = 0.0;      ///< Bound of the rounding error.
  bool undecided = false;  ///< Rounding may decide whether the weight is 0.
};

/// The normal that spans a pixel's plane.
glm::dvec3 planeNormal(const Guide& guide, const EdgeStoppingSettings& settings);

/// How far two pixels' planes face the same way: the cosine between their normals, or 1 where that has no say.
double facing(const Guide& a, const Guide& b, const EdgeStoppingSettings& settings);

/// Weight between a centre `p` and a pixel `q`: 1 near the plane through the centre, 0 away from it, outside the
/// picture and where there is no surface (Meunier & Harada 2022, 4.3).
EdgeWeight edgeWeight(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                      const EdgeStoppingSettings& settings);

/// Result of walking along a segment.
struct Trace {
  EdgeWeight weight{1.0, 0.0, false};  ///< The smallest met.
  int edge = 0;                        ///< Step at which it became 0; steps + 1 where it did not.
};

/// Walk from `p` in `direction` up to `steps` pixels (Meunier & Harada 2022, 3.3 and 5.2). A step is max(1,
/// floor(fraction x distance)) pixels, with the edge distance of the pixel just visited. Without edge tracing only the
/// far end is looked at.
/// @param distances edge distances that the last iteration found; empty where there is none
Trace traceEdge(const HostFrame& frame, const Image<Guide>& guides, const Image<int>& distances, glm::ivec2 p,
                glm::ivec2 direction, int steps, const WeightedRegressionSettings& settings);

/// The smallest weight on the straight line from `p` to another pixel, `p` left out (digital differential analyser). A
/// line that is an edge beyond doubt somewhere has weight and error 0.
EdgeWeight traceLine(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                     const EdgeStoppingSettings& settings);

}  // namespace walr::reference
