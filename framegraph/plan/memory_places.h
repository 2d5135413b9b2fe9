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

/// The part of a frame in which a resource's bytes hold something. It is, for a transient, from its first to its last
/// use; for a history's `current`, from its first use to the end of the frame; for a history's `previous`, from the
/// start of the frame to its last use.
PassSpan occupied(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

/// The images of histories whose bytes a transient aliases, ordered by name. Empty for other resources.
std::vector<std::uint32_t> aliasedHistoryImages(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

/// The place of a resource as text: "heap 1 [0, 4096) of accumulated.previous". Empty if it is in no heap.
std::string placeText(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

}  // namespace fg
