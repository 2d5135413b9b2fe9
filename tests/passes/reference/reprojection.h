#pragma once

#include <array>

#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// Where a surface was in the previous frame.
struct Reprojection {
  glm::dvec2 pixel{0.0};     ///< Position in the previous picture, pixels.
  glm::dvec3 position{0.0};  ///< In the previous frame's view space.
  glm::dvec3 normal{0.0};    ///< Its geometric normal there.
  bool valid = false;        ///< False where motion leaves the picture or is not finite.
};
/// @param dilateMotion follow the motion of the nearest surface of the 3x3 neighbourhood (walr.txt 4.2)
Reprojection reproject(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, bool dilateMotion);

/// One pixel of the previous frame that a surface's history may come from.
struct HistoryTap {
  glm::ivec2 pixel{0};
  double weight = 0.0;     ///< Bilinear.
  bool matches = false;    ///< Inside the picture and on the surface: plane distance and normal agree.
  bool undecided = false;  ///< Plane distance or normal lies so close to its threshold that rounding may decide.
};
/// The four pixels around a reprojected position, each tested on its own.
/// @param planeTolerance largest plane distance in units of depth
/// @param normalThreshold smallest cosine between geometric normals
std::array<HistoryTap, 4> historyTaps(const HostFrame& frame, const Reprojection& r, const Image<Guide>& previousGuides,
                                      double planeTolerance, double normalThreshold);

/// Largest error that single precision makes in `Reprojection::pixel`, pixels.
double pixelError(const Reprojection& r);

}  // namespace walr::reference
