#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::test {

/// Every two accesses to the same bytes, over frames, that nothing orders as the Vulkan specification has it: by a
/// chain of dependencies from the one to the other, which for a write includes one that makes it available and one that
/// makes it visible.
///
/// Where `fg::verify` replays a frame and carries along what is known of each piece of memory, this looks for the chain
/// of each pair by itself, takes nothing from pairs in between, and shares no code with it but the table of what an
/// access means. It knows of order and memory, not of contents: it is there to prove that a plan which `verify` accepts
/// has no hazard.
/// @return what is not ordered, in words
std::vector<std::string> unorderedAccesses(const GraphDesc& graph, const Plan& plan);

}  // namespace fg::test
