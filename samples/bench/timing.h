#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samples/bench/spread.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// Time of one pass over all timed frames.
struct PassSpread {
  std::string name;
  Spread milliseconds;
};

/// How long a variant takes.
struct Timing {
  std::size_t frames = 0;              ///< Behind the times, over all repetitions.
  std::optional<Spread> milliseconds;  ///< All passes of a frame; absent without a timer.
  /// Time over the baseline's on the same frame of the same repetition; absent without a timer.
  std::optional<Spread> ratio;
  std::vector<PassSpread> passes;  ///< In the order of execution.
};

/// Times of a variant's passes, frame after frame.
class FrameTimes {
 public:
  /// Nothing where the device has no timer.
  void add(const DenoisedPicture& picture);
  /// @param baseline  of the same frames
  [[nodiscard]] Timing timing(const FrameTimes& baseline) const;

 private:
  std::vector<double> milliseconds_;         ///< By frame.
  std::vector<std::string> names_;           ///< By pass.
  std::vector<std::vector<double>> passes_;  ///< By pass, then by frame.
};

/// A denoiser that is timed on two frames in turn.
struct TimedLane {
  GpuDenoiser denoiser;
  const std::array<PackedFrame, 2>* frames;
  FrameTimes times = {};
};

/// Frames of which each repetition of `timeBeside` consists.
inline constexpr std::size_t kFramesPerRepetition = 8;

/// Time denoisers beside each other, after one repetition that warms up. Who is first moves on from frame to frame, so
/// that drift hits all alike.
/// @param frameDone  called after each frame of all, `kFramesPerRepetition` times (1 + repetitions) times
/// @throws fg::vk::Error when the device fails
void timeBeside(std::vector<TimedLane>& lanes, std::size_t repetitions, const std::function<void()>& frameDone);

/// `timed_frames`, `milliseconds`, `ratio` and `passes` into an object, and back.
/// @throws nlohmann::json::exception from `timingFromJson` where something is missing
void addTiming(nlohmann::ordered_json& object, const Timing& timing);
Timing timingFromJson(const nlohmann::ordered_json& object);
nlohmann::ordered_json toJson(const Spread& spread);

}  // namespace walr
