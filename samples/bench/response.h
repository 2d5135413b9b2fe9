#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// What the first frame after a camera cut is like.
struct CutResponse {
  double rmse = 0.0;
  double left = 0.0;  ///< Share of the old picture that is still there, in linear luminance: 1 is all of it.
};

/// How a method answers to change, on synthetic scenes with a known answer (response_scene.h). Errors are after the
/// tone map x / (1 + x).
struct Response {
  std::string variant;
  double firstFrame = 0.0;      ///< RMSE of the first frame.
  double settled = 0.0;         ///< RMSE of a still scene in steady light, mean over frames 16 to 23.
  double settledFlicker = 0.0;  ///< Flicker (`flicker`) of the same frames.
  /// Share of the light that is still there but should not be, by frames since the light went down: 1 is all of it.
  std::vector<double> lightLeft;
  std::optional<int> lightFrames;  ///< Frames until no more than a tenth is left; absent where that is never.
  /// RMSE, relative to the truth's luminance, of the wall behind the slab, by frames since the slab uncovered it, after
  /// the first eight frames.
  std::vector<double> errorByAge;
  /// Share of the slab's light, in linear luminance, that is left on the wall, by the same: a ghost's trail.
  std::vector<double> trailByAge;
  /// Frames since disocclusion until the error is within a quarter of the wall's that nothing ever hid; absent where
  /// that is never.
  std::optional<int> recoveryFrames;
  /// How many frames ago light that moves over a still wall lay as the result shows it: the age whose truth is nearest
  /// to the result, mean over 24 frames.
  double lightLag = 0.0;
  CutResponse cut;        ///< Of the camera, told to the method.
  CutResponse untoldCut;  ///< The same, and nobody said so: what rejection by surface saves.
};

/// Ages up to which `Response::errorByAge` and `trailByAge` reach.
inline constexpr int kResponseAges = 16;

/// @throws fg::vk::Error when the device fails
std::vector<Response> responses(const GpuDevice& device, std::span<const Variant> variants);

}  // namespace walr
