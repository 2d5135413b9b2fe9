#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "samples/bench/spread.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// One kind of memory access, measured by itself.
struct BandwidthProbe {
  std::string name;
  std::string description;
  Spread milliseconds;
  double bytes = 0.0;    ///< Moved by one run: read plus written.
  double fetches = 0.0;  ///< Of texels, by one run; 0 for copies.
  std::optional<double> bytesPerSecond;
  std::optional<double> fetchesPerSecond;
  std::optional<double> secondsPerFetch;  ///< One after the other.
};

/// What a device's memory and texture units reach.
struct Bandwidth {
  std::uint64_t bytes = 0;  ///< Size of the buffer and of the texture that the probes use.
  std::optional<Spread> emptyPassMilliseconds;
  std::vector<BandwidthProbe> probes;
  std::string whyNot;  ///< Why there are none, or why smaller buffers than requested were used; empty without a reason.

  /// The probe with a name; null if it was not measured.
  [[nodiscard]] const BandwidthProbe* find(std::string_view name) const;
  /// The rate of the fastest probe; nothing without probes. Which it is depends on the driver: that of NVIDIA's H100
  /// copies at a third of the rate at which compute passes fetch.
  [[nodiscard]] std::optional<double> bytesPerSecond() const;
};

inline constexpr std::string_view kCachedFetches = "fetch from caches";

/// Measure copies by vkCmdCopy* and compute passes that only fetch.
/// @param side height of the texture in texels of 8 bytes, a power of two; it is twice as wide. Halved until it fits
///        into device memory
/// @param repetitions measured, after as many that warm up; fewer where they take more than three seconds
/// @throws fg::vk::Error when the device fails
Bandwidth measureBandwidth(const GpuDevice& device, std::uint32_t side, std::size_t repetitions);

}  // namespace walr
