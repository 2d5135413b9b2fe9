#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace walr {

/// What a frame's result is off by. A figure is absent where it has no value.
struct FrameErrors {
  int frame = 0;
  bool resetHistory = false;  ///< First frame, or a camera cut: no temporal figures.
  std::optional<double> rmse;
  std::optional<double> psnr;
  std::optional<double> ssim;
  std::optional<double> flip;
  std::optional<double> relativeMse;
  std::optional<double> flicker;
  std::optional<double> luminanceChange;
  std::optional<double> referenceLuminanceChange;
  std::optional<double> vmaf;
  std::size_t nonFinite = 0;  ///< Values of the result that are not finite.
};

/// A figure of `FrameErrors` by its name in files.
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
           "change of the error along motion, disocclusions masked; white noise of deviation s gives s"},
    Metric{"luminance_change", &FrameErrors::luminanceChange, Metric::Better::AsReference,
           "mean change of luminance from frame to frame at fixed pixels"},
    Metric{"reference_luminance_change", &FrameErrors::referenceLuminanceChange, Metric::Better::AsReference,
           "the reference's own"},
    Metric{"vmaf", &FrameErrors::vmaf, Metric::Better::Higher,
           "VMAF (Li et al. 2016) by libvmaf, 0 to 100, after the tone map, 8 bits; hardly sees fine noise"},
};

/// Mean of a figure over the frames that have it.
std::optional<double> meanOf(const std::vector<FrameErrors>& frames, const Metric& metric);
/// The worst figure of all frames; nothing for figures that have no better or worse.
std::optional<double> worstOf(const std::vector<FrameErrors>& frames, const Metric& metric);

/// Without the frames in which history builds up (`kWarmUpFrames`): those at the start of a sequence.
std::vector<FrameErrors> afterWarmUp(const std::vector<FrameErrors>& frames);

}  // namespace walr
