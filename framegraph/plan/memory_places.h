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

/// When in a frame a resource's bytes hold something: from the first use to the last; an image of a history to the end
/// of the frame once it is written, and from the beginning until it has been read for the last time.
PassSpan occupied(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

/// The images of histories, by name, whose bytes a transient has while they hold nothing; none for other resources.
std::vector<std::uint32_t> lenders(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

/// Where a resource lies: "heap 1 [0, 4096) of accumulated.previous"; empty where that is in no heap.
std::string placeInWords(const GraphDesc& graph, const Plan& plan, std::uint32_t resource);

}  // namespace fg
