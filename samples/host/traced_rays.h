#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace walr::host {

/// Rays of one or several frames, counted as they were cast, and how long that took.
struct TracedRays {
  std::uint64_t rays = 0;
  double seconds = 0.0;  ///< Of tracing alone; 0 on a device that does not measure times.

  TracedRays& operator+=(const TracedRays& other);
  /// Rays traced in a second of tracing; nothing without a time.
  [[nodiscard]] std::optional<double> perSecond() const;
};

/// Such as "12.3 million rays/s"; "no times" without a time.
std::string rateText(const TracedRays& traced);

}  // namespace walr::host
