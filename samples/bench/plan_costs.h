#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "samples/bench/variant.h"

namespace walr {

/// The sizes that costs are always reported for: 720p, 1080p, 1440p and 4K.
inline constexpr std::array kCommonExtents = {fg::Extent{1280, 720}, fg::Extent{1920, 1080}, fg::Extent{2560, 1440},
                                              fg::Extent{3840, 2160}};

/// Costs of a method from its frame-graph plan, which hold on any device. Memory assumes tightly packed texels.
struct PlanCosts {
  fg::Extent extent;
  /// Every texel of every texture that a pass reads or writes, counted once per pass and direction: the memory traffic
  /// with perfect caches.
  double bytesReadPerPixel = 0.0;
  double bytesWrittenPerPixel = 0.0;
  std::uint64_t persistentBytes = 0;          ///< Histories: both textures of each.
  std::uint64_t transientUnaliasedBytes = 0;  ///< Transient textures, if none were aliased.
  std::uint64_t transientPeakBytes = 0;       ///< Transient textures, with the plan's aliasing.
  /// ESTIMATED time on `kDefaultMachine` (`estimatedMicroseconds`), which is no measurement.
  std::optional<double> estimatedMicroseconds;
};

/// @throws std::invalid_argument naming a setting that is out of range
PlanCosts planCosts(const Variant& variant, fg::Extent extent, const InputConventions& conventions);

}  // namespace walr
