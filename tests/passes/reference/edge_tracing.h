#pragma once

#include "passes/regression/weighted_regression.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// A weight, with the effect that single precision may have on it.
struct EdgeWeight {
  double weight = 0.0;
  double error = 0.0;      ///< Bound of the rounding error.
  bool undecided = false;  ///< Rounding may decide whether the weight is 0.
};

/// The normal that spans a pixel's plane.
glm::dvec3 planeNormal(const Guide& guide, const EdgeStoppingSettings& settings);

/// The factor max(g_b . g_q, 0) of passes/WALR.md, 5: the cosine between the normals of two pixels' planes; 1 with
/// `normalFactor` off.
double facing(const Guide& a, const Guide& b, const EdgeStoppingSettings& settings);

/// The edge-stopping function between a centre `p` and a pixel `q` (Meunier & Harada 2022, 4.3; e in passes/WALR.md,
/// 4): 1 near the plane through the centre; 0 away from it, outside the image and where there is no surface.
EdgeWeight edgeWeight(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                      const EdgeStoppingSettings& settings);

/// Result of tracing a segment.
struct Trace {
  EdgeWeight weight{1.0, 0.0, false};  ///< The smallest on the segment.
  int edge = 0;                        ///< Step at which it became 0; steps + 1 where it did not.
};

/// Edge tracing (Meunier & Harada 2022, 3.3): walk from `p` in `direction` up to `steps` pixels. Each step is max(1,
/// floor(fraction x distance)) pixels long, with the edge distance of the pixel just visited (5.2, figure 7). With edge
/// tracing off only the far end is evaluated.
/// @param distances edge distances that the previous iteration found; empty in the first one
Trace traceEdge(const HostFrame& frame, const Image<Guide>& guides, const Image<int>& distances, glm::ivec2 p,
                glm::ivec2 direction, int steps, const WeightedRegressionSettings& settings);

/// Edge tracing along any straight line, as REFWLR does (Meunier & Harada 2022, 6): the smallest weight from `p` to
/// `q`, `p` left out (digital differential analyser). Weight and error are 0 if the line meets an edge that rounding
/// cannot remove.
EdgeWeight traceLine(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                     const EdgeStoppingSettings& settings);

}  // namespace walr::reference
