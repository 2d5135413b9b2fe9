#pragma once

#include "passes/temporal_accumulation.h"
#include "tests/passes/reference/reprojection.h"

namespace walr::reference {

/// What a history texture says about a surface.
struct HistorySample {
  glm::dvec4 value{0.0};   ///< rgb: mean; a: number of samples behind it.
  glm::dvec4 error{0.0};   ///< Bound of what single precision adds.
  bool found = false;      ///< Whether any pixel shows the surface.
  bool undecided = false;  ///< A decision lay within rounding: single precision may differ by more than `error`.
};

/// Catmull-Rom spline weights of the four points around a position `f` past the second.
std::array<double, 4> catmullRom(double f);

/// Read a history texture at a reprojected position from the taps that match. Bicubic reading needs all four taps to
/// match and all sixteen pixels to have a history, else it falls back to bilinear; the number of samples is always read
/// bilinearly.
HistorySample sampleHistory(const Reprojection& r, const std::array<HistoryTap, 4>& taps,
                            const Image<glm::dvec4>& previous, HistoryFilter filter);

}  // namespace walr::reference
