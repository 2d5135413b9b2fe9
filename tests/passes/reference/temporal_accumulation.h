#pragma once

#include "tests/passes/reference/history.h"

namespace walr::reference {

/// A running mean over time.
struct Accumulated {
  glm::dvec3 mean{0.0};
  double samples = 0.0;   ///< Number of samples in the mean: the history length.
  glm::dvec3 error{0.0};  ///< Bound of what single-precision arithmetic adds to the mean.
  double samplesError = 0.0;
  /// Luminance of the frame's light minus that of history, d of passes/WALR.md, 3; 0 where one of them is missing.
  double difference = 0.0;
  double differenceError = 0.0;
  bool undecided = false;  ///< A decision lay within rounding: single precision may differ by more than `error`.
};

/// Guides and running means of the previous frame.
struct AccumulationHistory {
  Image<Guide> guides;            ///< Empty while there is no history.
  Image<glm::dvec4> accumulated;  ///< rgb: mean; a: number of samples.
  Image<double> antilag = {};     ///< Antilag factor of each tile; empty where antilag is off.
};

/// Temporal accumulation, the preprocessing phase (Meunier & Harada 2022, 4.2; passes/WALR.md, 2): a cumulative moving
/// average that becomes exponential after `maxHistory` samples.
/// @param keepTaps    whether later stages read the history taps of this one, for which the motion is rounded
/// @param onLightGrid whether only pixels with a sample of sparse light have a mean, from those of the previous frame
///                    (passes/WALR.md, 2)
Image<Accumulated> accumulate(const HostFrame& frame, const Image<Guide>& guides, const AccumulationHistory& previous,
                              Storage storage, const TemporalAccumulationSettings& settings = {}, bool keepTaps = false,
                              bool onLightGrid = false);

/// Mean and history length, which the next stages and the next frame read.
Image<glm::dvec4> meansAndLengths(const Image<Accumulated>& accumulated);

}  // namespace walr::reference
