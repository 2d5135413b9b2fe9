#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// Errors of the first frame after a camera cut.
struct CutResponse {
  double rmse = 0.0;
  double left = 0.0;  ///< Share of the image before the cut that remains, in linear luminance: 0 to 1.
};

/// How a method responds to change, on synthetic scenes with known truth (response_scene.h). Errors are after the tone
/// map x / (1 + x).
struct Response {
  std::string variant;
  double firstFrame = 0.0;      ///< RMSE of the first frame.
  double settled = 0.0;         ///< RMSE of a static scene in constant light, mean over frames 16 to 23.
  double settledFlicker = 0.0;  ///< Flicker (`flicker`) of the same frames.
  /// Share of the removed light that remains, by the number of frames since the light was dimmed: 1 is all of it.
  std::vector<double> lightLeft;
  std::optional<int> lightFrames;  ///< Frames until at most a tenth remains; absent if that is never reached.
  /// RMSE of the wall behind the slab, relative to the truth's luminance, by the number of frames since the slab
  /// uncovered it. The first eight frames are left out.
  std::vector<double> errorByAge;
  /// Trail: share of the slab's light that remains on the wall, in linear luminance, by the same number of frames.
  std::vector<double> trailByAge;
  /// Frames from disocclusion until the error is at most 5/4 of that of wall pixels that were never hidden; absent if
  /// that is never reached.
  std::optional<int> recoveryFrames;
  /// Lag in frames of light that moves over a static wall: the age of the truth that is nearest to the result, mean
  /// over 24 frames.
  double lightLag = 0.0;
  CutResponse cut;        ///< A camera cut that the frame reports to the method.
  CutResponse untoldCut;  ///< A camera cut that the frame does not report: history is rejected by surface only.
};

/// Number of ages in `Response::errorByAge` and `trailByAge`.
inline constexpr int kResponseAges = 16;

/// @throws fg::vk::Error when the device fails
std::vector<Response> responses(const GpuDevice& device, std::span<const Variant> variants);

}  // namespace walr
