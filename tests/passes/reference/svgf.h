#pragma once

#include <cstdint>
#include <optional>

#include "passes/filters/svgf_filter.h"
#include "passes/temporal/svgf_accumulation.h"
#include "tests/passes/reference/guides.h"
#include "tests/passes/reference/reprojection.h"

namespace walr::reference {

/// Integrated colour and luminance moments (Schied et al. 2017, 4.1 and 4.2).
struct SvgfMoments {
  glm::dvec3 colour{0.0};
  double mean = 0.0;      ///< Mean luminance.
  double square = 0.0;    ///< Mean squared luminance: the paper's raw second moment.
  double nearness = 0.0;  ///< Of specular light: mean of the view depth over the distance of what is reflected.
  double samples = 0.0;   ///< History length.
  /// Bounds of what single precision adds, for the colour, and for mean, square, nearness and samples.
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
  Image<glm::dvec4> moments;  ///< Mean luminance, mean squared luminance, nearness, history length.
};

/// What is given for specular light in place of the surface's reprojection.
struct SvgfReflection {
  glm::dvec2 motion{0.0};         ///< Of all pixels.
  Image<std::uint32_t> accepted;  ///< Of the four taps in the order of `historyTaps`, as bits.
  Image<double> confidence;
};

/// The specular lobe of a pixel.
struct Lobe {
  glm::dvec3 direction{0.0};  ///< Of the mirrored view ray, view space.
  double angle = 0.0;         ///< Half angle 2 atan r^2 of linear roughness r.
  double nearness = 0.0;      ///< `SvgfMoments::nearness`.
};

/// Lobes as a device stores them, the last two values as halves, but with exact directions.
Image<Lobe> svgfLobes(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments);

/// Temporal filtering (Schied et al. 2017, 4.1 and 4.2), with the paper's raw moments.
Image<SvgfMoments> svgfAccumulate(const HostFrame& frame, const Image<Guide>& guides, const SvgfHistory& history,
                                  const SvgfAccumulationSettings& settings = {},
                                  const std::optional<SvgfReflection>& reflection = {});

/// Variance estimation (Schied et al. 2017, 4.2): temporal, or over 7x7 pixels where the history is short.
Image<SvgfPixel> svgfVariance(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments,
                              const SvgfFilterSettings& settings = {});

/// Moments of a single frame, from which the spatial variance estimate starts (Schied et al. 2017, 4.2).
Image<SvgfMoments> svgfSingleFrame(const HostFrame& frame, const Image<Guide>& guides);

/// One iteration of the edge-avoiding a-trous wavelet transform (Schied et al. 2017, 4.3), its taps `spacing` pixels
/// apart; with SvgfWindow::Full and a spacing of 1, the window of all iterations at once.
/// @param lobes of specular light, else empty
Image<SvgfPixel> svgfAtrous(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfPixel>& input,
                            int spacing, const SvgfFilterSettings& settings = {}, const Image<Lobe>& lobes = {});

}  // namespace walr::reference
