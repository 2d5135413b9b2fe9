#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samples/bench/spread.h"
#include "samples/denoise/gpu_denoiser.h"

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

/// `timed_frames`, `milliseconds`, `ratio` and `passes` into an object, and back.
/// @throws nlohmann::json::exception from `timingFromJson` where something is missing
void addTiming(nlohmann::ordered_json& object, const Timing& timing);
Timing timingFromJson(const nlohmann::ordered_json& object);
nlohmann::ordered_json toJson(const Spread& spread);

}  // namespace walr
