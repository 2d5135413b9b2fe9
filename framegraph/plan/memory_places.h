#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Positions in `Plan::passes`.
struct PassSpan {
  std::uint32_t first = 0;
  std::uint32_t last = 0;  ///< Inclusive.
};

/// When in a frame a resource's bytes hold something. A transient: from its first to its last use. A history's
/// `current`: from its first use to the end of the frame. A history's `previous`: from the frame's start to its last
/// use.
PassSpan occupied(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

/// The images of histories, by name, whose bytes a transient aliases; none for other resources.
std::vector<std::uint32_t> aliasedHistoryImages(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

/// Where a resource lies: "heap 1 [0, 4096) of accumulated.previous"; empty where that is in no heap.
std::string placeInWords(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

}  // namespace fg
