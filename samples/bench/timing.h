#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "framegraph/vulkan/executor.h"
#include "samples/bench/spread.h"

namespace walr {

/// Time of one pass over all timed frames.
struct PassSpread {
  std::string name;
  Spread milliseconds;
};

/// Times of a variant.
struct Timing {
  std::size_t frames = 0;              ///< Number of timed frames, over all repetitions.
  std::optional<Spread> milliseconds;  ///< All passes of a frame; absent without a timer.
  /// Ratio to the baseline's time on the same frame of the same repetition; absent without a timer.
  std::optional<Spread> ratio;
  std::vector<PassSpread> passes;  ///< In the order of execution.
};

/// Collects the times of a variant's passes over frames.
class FrameTimes {
 public:
  /// Add a frame. No passes, as of a device without a timer, have no effect.
  void add(std::span<const fg::vk::PassTime> passes);
  /// @param baseline  times of the baseline on the same frames
  [[nodiscard]] Timing timing(const FrameTimes& baseline) const;
  /// Without ratios.
  [[nodiscard]] Timing timing() const;

 private:
  std::vector<double> milliseconds_;         ///< Indexed by frame.
  std::vector<std::string> names_;           ///< Indexed by pass.
  std::vector<std::vector<double>> passes_;  ///< Indexed by pass, then by frame.
};

/// Write `timed_frames`, `milliseconds`, `ratio` and `passes` to a JSON object, and read them back.
/// @throws nlohmann::json::exception from `timingFromJson` if a member is missing
void addTiming(nlohmann::ordered_json& object, const Timing& timing);
Timing timingFromJson(const nlohmann::ordered_json& object);
nlohmann::ordered_json toJson(const Spread& spread);

}  // namespace walr
