#pragma once

#include "tests/passes/reference/history.h"

namespace walr::reference {

/// A running mean.
struct Accumulated {
  glm::dvec3 mean{0.0};
  double samples = 0.0;   ///< Number of samples behind it.
  glm::dvec3 error{0.0};  ///< Bound of what single-precision arithmetic adds to the mean.
  double samplesError = 0.0;
  /// Luminance of the frame's light less that of history; 0 where one of them is missing.
  double difference = 0.0;
  double differenceError = 0.0;
  bool undecided = false;  ///< A decision lay within rounding: single precision may differ by more than `error`.
};

/// What a picture of running means was one frame ago.
struct AccumulationHistory {
  Image<Guide> guides;            ///< Empty while there is no history.
  Image<glm::dvec4> accumulated;  ///< rgb: mean; a: number of samples.
  Image<double> antilag = {};     ///< In history, by tiles; empty where nobody detects light that changes.
};

/// The preprocessing accumulation (Meunier & Harada 2022, 4.2): cumulative mean that turns exponential after
/// `maxHistory`.
/// @param keepTaps whether later stages are told where the history was, which rounds it
Image<Accumulated> accumulate(const HostFrame& frame, const Image<Guide>& guides, const AccumulationHistory& previous,
                              Storage storage, const TemporalAccumulationSettings& settings = {},
                              bool keepTaps = false);

/// The part of a running mean that the next stages and the next frame read.
Image<glm::dvec4> meansAndLengths(const Image<Accumulated>& accumulated);

}  // namespace walr::reference
