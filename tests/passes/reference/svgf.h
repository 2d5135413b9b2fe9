#pragma once

#include "passes/svgf_accumulation.h"
#include "passes/svgf_filter.h"
#include "tests/passes/reference/guides.h"
#include "tests/passes/reference/reprojection.h"

namespace walr::reference {

/// Colour and the statistics of its luminance, as SVGF's temporal filtering keeps them.
struct SvgfMoments {
  glm::dvec3 colour{0.0};
  double mean = 0.0;     ///< Mean luminance.
  double square = 0.0;   ///< Mean squared luminance: the paper's raw second moment.
  double samples = 0.0;  ///< History length.
  /// Bounds of what single precision adds: to the colour, and to mean, square, nothing and samples.
  glm::dvec4 colourError{0.0};
  glm::dvec4 momentError{0.0};
  bool undecided = false;  ///< A decision lay within rounding: single precision may differ by more.

  [[nodiscard]] double variance() const;
};

/// A colour with the statistics of its luminance, on its way through the filter.
struct SvgfPixel {
  glm::dvec3 colour{0.0};
  double deviation = 0.0;  ///< Standard deviation of the luminance; negative where no sample has been seen.
  /// Mean distance of the weighted taps from their mean: what an error of the weights is multiplied by.
  glm::dvec3 spread{0.0};
  /// Mean squared distance of the weighted luminances from the pixel's own: the same for a variance.
  double secondMoment = 0.0;
};

/// What the pixels were one frame ago.
struct SvgfHistory {
  Image<Guide> guides;        ///< Empty while there is no history.
  Image<glm::dvec4> colour;   ///< rgb.
  Image<glm::dvec4> moments;  ///< Mean luminance, mean squared luminance, 0, history length.
};

/// Temporal filtering (Schied et al. 2017, 4.1 and 4.2), with the paper's raw moments.
Image<SvgfMoments> svgfAccumulate(const HostFrame& frame, const Image<Guide>& guides, const SvgfHistory& history,
                                  const SvgfAccumulationSettings& settings = {});

/// Variance estimation (4.2): temporal, or over 7x7 pixels where the history is short.
Image<SvgfPixel> svgfVariance(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments,
                              const SvgfFilterSettings& settings = {});

/// Moments of one frame by itself: what the spatial variance estimate starts from.
Image<SvgfMoments> svgfSingleFrame(const HostFrame& frame, const Image<Guide>& guides);

/// One a-trous iteration (4.4), its taps `spacing` pixels apart; or, with a spacing of 1, the full window.
Image<SvgfPixel> svgfAtrous(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfPixel>& input,
                            int spacing, const SvgfFilterSettings& settings = {});

}  // namespace walr::reference
