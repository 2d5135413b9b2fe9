#pragma once

#include "passes/filters/svgf_filter.h"
#include "passes/temporal/svgf_accumulation.h"
#include "tests/passes/reference/guides.h"
#include "tests/passes/reference/reprojection.h"

namespace walr::reference {

/// Integrated colour and luminance moments (Schied et al. 2017, 4.1 and 4.2).
struct SvgfMoments {
  glm::dvec3 colour{0.0};
  double mean = 0.0;     ///< Mean luminance.
  double square = 0.0;   ///< Mean squared luminance: the paper's raw second moment.
  double samples = 0.0;  ///< History length.
  /// Bounds of what single precision adds, for the colour, and for mean, square, an unused component and samples.
  glm::dvec4 colourError{0.0};
  glm::dvec4 momentError{0.0};
  bool undecided = false;  ///< A decision lay within rounding: single precision may differ by more.

  /// Variance of the luminance from its raw moments (Schied et al. 2017, 4.2).
  [[nodiscard]] double variance() const;
};

/// A colour with the deviation of its luminance, input and output of the a-trous iterations.
struct SvgfPixel {
  glm::dvec3 colour{0.0};
  double deviation = 0.0;  ///< Standard deviation of the luminance; negative where there is no sample.
  /// Mean distance of the weighted taps from their mean: the factor by which an error of the weights changes the
  /// colour.
  glm::dvec3 spread{0.0};
  /// Mean squared distance of the weighted luminances from the pixel's own: the same factor for the variance.
  double secondMoment = 0.0;
};

/// Guides, colours and moments of the previous frame.
struct SvgfHistory {
  Image<Guide> guides;        ///< Empty while there is no history.
  Image<glm::dvec4> colour;   ///< rgb.
  Image<glm::dvec4> moments;  ///< Mean luminance, mean squared luminance, 0, history length.
};

/// Temporal filtering (Schied et al. 2017, 4.1 and 4.2), with the paper's raw moments.
Image<SvgfMoments> svgfAccumulate(const HostFrame& frame, const Image<Guide>& guides, const SvgfHistory& history,
                                  const SvgfAccumulationSettings& settings = {});

/// Variance estimation (Schied et al. 2017, 4.2): temporal, or over 7x7 pixels where the history is short.
Image<SvgfPixel> svgfVariance(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments,
                              const SvgfFilterSettings& settings = {});

/// Moments of a single frame, from which the spatial variance estimate starts (Schied et al. 2017, 4.2).
Image<SvgfMoments> svgfSingleFrame(const HostFrame& frame, const Image<Guide>& guides);

/// One iteration of the edge-avoiding a-trous wavelet transform (Schied et al. 2017, 4.3), its taps `spacing` pixels
/// apart; with SvgfWindow::Full and a spacing of 1, the window of all iterations at once.
Image<SvgfPixel> svgfAtrous(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfPixel>& input,
                            int spacing, const SvgfFilterSettings& settings = {});

}  // namespace walr::reference
