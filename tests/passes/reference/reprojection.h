#pragma once

#include <array>

#include "passes/history_tests.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// Where a surface was in the previous frame.
struct Reprojection {
  glm::dvec2 pixel{0.0};     ///< Position in the previous picture, pixels.
  glm::dvec3 position{0.0};  ///< In the previous frame's view space.
  glm::dvec3 normal{0.0};    ///< Its geometric normal there.
  std::uint32_t object = 0;  ///< Whose it is, as in `Guide`.
  bool valid = false;        ///< False where motion leaves the picture or is not finite.
  bool undecided = false;    ///< Rounding may decide which of two motions is kept.
  double error = 0.0;        ///< What single precision may add to `pixel`, pixels.
};

/// How the way to the previous frame is found.
struct ReprojectionOptions {
  /// Follow the motion of the nearest surface of the 3x3 neighbourhood (Meunier & Harada 2022, 4.2).
  bool dilateMotion = false;
  bool keepTaps = false;  ///< Round the motion to what later stages are told of it: halves with 9 significant bits.
};
Reprojection reproject(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p,
                       const ReprojectionOptions& options = {});

/// What tells a history pixel of the surface from that of another.
struct HistoryTests {
  HistoryRejection rejection = HistoryRejection::Plane;
  double planeTolerance = 0.0;   ///< Largest distance from the plane, or of the depth, in units of depth.
  double normalThreshold = 0.0;  ///< Smallest cosine between geometric normals.
  bool objects = false;          ///< Of another object is not of the surface.
};
template <typename Settings>
HistoryTests historyTestsOf(const Settings& settings) {
  return {settings.rejection, double(settings.planeTolerance), double(settings.normalThreshold)};
}

/// One pixel of the previous frame that a surface's history may come from.
struct HistoryTap {
  glm::ivec2 pixel{0};
  double weight = 0.0;     ///< Bilinear.
  bool matches = false;    ///< Inside the picture and on the surface.
  bool undecided = false;  ///< A test is so close to its threshold that rounding may decide.
};
/// The four pixels around a reprojected position, each tested on its own.
std::array<HistoryTap, 4> historyTaps(const HostFrame& frame, const Reprojection& r, const Image<Guide>& previousGuides,
                                      const HistoryTests& tests);

}  // namespace walr::reference
