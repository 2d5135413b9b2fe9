#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "samples/denoise/roughness_classes.h"

namespace walr {

/// Errors of a frame's result. A value is absent where it is undefined, for instance without a reference.
struct FrameErrors {
  int frame = 0;
  bool resetHistory = false;  ///< First frame, or a camera cut: no temporal errors.
  std::optional<double> rmse;
  std::optional<double> psnr;
  std::optional<double> ssim;
  std::optional<double> flip;
  std::optional<double> relativeMse;
  std::optional<double> flicker;
  std::optional<double> luminanceChange;
  std::optional<double> referenceLuminanceChange;
  FiguresByRoughness byRoughness;             ///< RMSE of each class, of specular light.
  std::optional<double> cleanSquare;          ///< See `cleanSquare`; of specular light.
  FiguresByRoughness cleanSquareByRoughness;  ///< The same of each class.
  std::size_t nonFinite = 0;                  ///< Number of non-finite values in the result.
};

/// A member of `FrameErrors` and its name in files.
struct Metric {
  enum class Better { Lower, Higher, AsReference };
  std::string_view name;
  std::optional<double> FrameErrors::*figure;
  Better better;
  std::string_view description;
};

inline constexpr std::array kMetrics = {
    Metric{"rmse", &FrameErrors::rmse, Metric::Better::Lower, "root mean square error after the tone map x/(1+x)"},
    Metric{"psnr", &FrameErrors::psnr, Metric::Better::Higher, "dB against a peak of 1, after the tone map"},
    Metric{"ssim", &FrameErrors::ssim, Metric::Better::Higher,
           "structural similarity (Wang et al. 2004), after the tone map"},
    Metric{"flip", &FrameErrors::flip, Metric::Better::Lower,
           "LDR-FLIP (Andersson et al. 2020) at 67 pixels per degree, after the tone map"},
    Metric{"relative_mse", &FrameErrors::relativeMse, Metric::Better::Lower,
           "mean of (x - r)^2 / (r^2 + 0.01) in linear radiance"},
    Metric{"flicker", &FrameErrors::flicker, Metric::Better::Lower,
           "change of the error along motion, without disocclusions; white noise of standard deviation s gives s"},
    Metric{"luminance_change", &FrameErrors::luminanceChange, Metric::Better::AsReference,
           "mean change of luminance from frame to frame at fixed pixels"},
    Metric{"reference_luminance_change", &FrameErrors::referenceLuminanceChange, Metric::Better::AsReference,
           "the same of the reference"},
};

/// Mean of a metric over the frames that have it.
std::optional<double> meanOf(const std::vector<FrameErrors>& frames, const Metric& metric);
/// Mean RMSE of each class over the frames that have it.
FiguresByRoughness meanByRoughness(const std::vector<FrameErrors>& frames);
/// The worst value of all frames; nullopt for metrics without better and worse.
std::optional<double> worstOf(const std::vector<FrameErrors>& frames, const Metric& metric);

/// The frames without the first `kWarmUpFrames`, in which history builds up; all if there are no more.
std::vector<FrameErrors> afterWarmUp(const std::vector<FrameErrors>& frames);

}  // namespace walr
