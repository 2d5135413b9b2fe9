#pragma once

#include <array>
#include <span>

#include "passes/guides/history_tests.h"
#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// The position of a surface in the previous frame.
struct Reprojection {
  glm::dvec2 pixel{0.0};     ///< Position in the previous image, pixels.
  glm::dvec3 position{0.0};  ///< In the previous frame's view space.
  glm::dvec3 normal{0.0};    ///< Geometric normal in the previous frame's view space.
  std::uint32_t object = 0;  ///< Object of the surface, numbered as in `Guide`.
  bool findsDepth = false;   ///< Depth is found among the history taps; `position` is that of a still surface.
  bool valid = false;        ///< False where motion leaves the image or is not finite.
  bool undecided = false;    ///< Rounding may change to which of two values the motion is rounded.
  double error = 0.0;        ///< Bound of what single precision adds to `pixel`, pixels.
};

/// How surfaces are reprojected.
struct ReprojectionOptions {
  /// Follow the motion of the nearest surface of the 3x3 neighbourhood (Meunier & Harada 2022, 4.2).
  bool dilateMotion = false;
  /// The same, and what is nearest is told by depths rounded down to 12 significant bits (`antialiasing.pixel-area`).
  bool dilateByShortDepth = false;
  bool keepTaps = false;  ///< Round the motion as for the texture of history taps: to halves with 9 significant bits.
};
/// The pixel whose motion the history of pixel `p` follows.
glm::ivec2 followedPixel(const Image<Guide>& guides, glm::ivec2 p, const ReprojectionOptions& options);
/// Reproject the surface at a pixel (Meunier & Harada 2022, 4.2): its position in the previous image by motion vector,
/// or by the camera alone, and its depth there by `motion.z`.
Reprojection reproject(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p,
                       const ReprojectionOptions& options = {});

/// What the tests of a history tap measure.
struct Measured {
  double value = 0.0;      ///< Distance from the previous camera along the surface's normal or, by depth, view axis.
  double error = 0.0;      ///< Bound of what single precision adds to its difference from the surface's.
  bool candidate = false;  ///< The tap passes all other tests.
};
/// A surface's own value of `Measured`.
struct OwnValue {
  double value = 0.0;
  bool found = true;
  bool undecided = false;  ///< Rounding may decide which tap it is taken from.
};
/// The value of the candidate nearest to that of a still surface, if it is within a tenth of it, or the tolerance.
OwnValue nearestTap(std::span<const Measured> taps, double still, double tolerance);

/// The tests by which a history tap is accepted (passes/WALR.md, 2).
struct HistoryTests {
  HistoryRejection rejection = HistoryRejection::Plane;
  double planeTolerance = 0.0;   ///< Largest distance from the plane, or difference of depth, in units of depth.
  double normalThreshold = 0.0;  ///< Smallest cosine between geometric normals.
  bool objects = false;          ///< Reject pixels of other objects (Wang 2024, 3).
};
template <typename Settings>
HistoryTests historyTestsOf(const Settings& settings) {
  return {settings.rejection, double(settings.thresholds.planeTolerance), double(settings.thresholds.normalThreshold)};
}

/// One of the four pixels of the previous frame around a reprojected position.
struct HistoryTap {
  glm::ivec2 pixel{0};
  double weight = 0.0;     ///< Bilinear weight.
  bool matches = false;    ///< Accepted: it lies inside the image and shows the surface.
  bool undecided = false;  ///< A test is so close to its threshold that rounding may decide.
};
/// Where history taps lie: the pixels `first` + k `spacing` of the previous frame, for all pairs k of whole numbers. By
/// default these are all pixels.
struct TapGrid {
  glm::ivec2 spacing{1};
  glm::ivec2 first{0};
};
/// The pixels that sparse light had samples of in the frame before (WalrConventions::light_group).
inline TapGrid previousLightGrid(const HostFrame& frame) {
  const LightPattern& light = frame.conventions.light;
  return {glm::ivec2(light.columns, light.rows), frame.constants.previousLightOffset};
}

/// The four history taps around a reprojected position, each tested on its own (passes/WALR.md, 2; with
/// HistoryRejection::Depth Meunier & Harada 2022, 4.2).
std::array<HistoryTap, 4> historyTaps(const HostFrame& frame, const Reprojection& r, const Image<Guide>& previousGuides,
                                      const HistoryTests& tests, const TapGrid& grid = {});

}  // namespace walr::reference
