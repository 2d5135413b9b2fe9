#pragma once

#include "passes/temporal/temporal_accumulation.h"
#include "tests/passes/reference/reprojection.h"

namespace walr::reference {

/// The history of a surface, read from a history texture.
struct HistorySample {
  glm::dvec4 value{0.0};   ///< rgb: mean; a: number of samples behind it.
  glm::dvec4 error{0.0};   ///< Bound of what single precision adds.
  bool found = false;      ///< Whether any pixel shows the surface.
  bool undecided = false;  ///< A decision lay within rounding: single precision may differ by more than `error`.
};

/// How a history texture is read.
struct HistoryReading {
  HistoryFilter filter = HistoryFilter::Bilinear;
  double sharpness = 0.5;       ///< Of a bicubic filter, 0 to 1; 1/2 is Catmull-Rom (Meunier & Harada 2022, 4.2).
  bool countEmptyTaps = false;  ///< Accepted taps without history count as of length 0 in the history length.
};

/// Weights of four points, for a position `f` past the second one, by the kernel of Keys 1981, equation 4, where a is
/// -`sharpness`.
std::array<double, 4> cubicWeights(double f, double sharpness);

/// Read a history texture at a reprojected position (Meunier & Harada 2022, 4.2; passes/WALR.md, 2 and 9). A bicubic
/// read needs all four taps accepted and a history in all twelve pixels; otherwise it falls back to the bilinear mean
/// of the accepted taps. The history length is always read bilinearly.
HistorySample sampleHistory(const Reprojection& r, const std::array<HistoryTap, 4>& taps,
                            const Image<glm::dvec4>& previous, const HistoryReading& reading);

}  // namespace walr::reference
