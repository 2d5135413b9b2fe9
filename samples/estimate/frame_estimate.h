#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "samples/estimate/machine.h"

namespace walr {

/// ESTIMATED time of a frame: the sum over the plan's batches, whose passes run side by side.
class FrameEstimate {
 public:
  /// @param bounds nothing for a pass without an estimate
  void add(std::uint32_t batch, const std::optional<Bounds>& bounds);
  /// Nothing if a pass has no estimate.
  [[nodiscard]] std::optional<double> microseconds() const;

 private:
  std::map<std::uint32_t, std::optional<Bounds>> batches_;
};

}  // namespace walr
