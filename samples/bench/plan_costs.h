#pragma once

#include <cstdint>
#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/inputs.h"
#include "samples/bench/variant.h"

namespace walr {

/// What a method costs on any device, from its frame-graph plan. Memory is that of tightly packed texels.
struct PlanCosts {
  fg::Extent extent;
  /// Every texel of every texture that a pass touches, counted once a pass and direction: the traffic of perfect
  /// caches.
  double bytesReadPerPixel = 0.0;
  double bytesWrittenPerPixel = 0.0;
  std::optional<double> tapsPerPixel;         ///< See `tapsPerPixel`.
  std::uint64_t persistentBytes = 0;          ///< Histories, both slots.
  std::uint64_t transientUnaliasedBytes = 0;  ///< Textures within a frame, were none to share memory.
  std::uint64_t transientPeakBytes = 0;       ///< The same as the plan shares it.
};

/// @throws std::invalid_argument naming a setting out of range
PlanCosts planCosts(const Variant& variant, fg::Extent extent, const InputConventions& conventions);

}  // namespace walr
