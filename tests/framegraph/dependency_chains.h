#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg::test {

/// Finds all pairs of conflicting accesses to the same bytes, over several frames, that are not ordered. Two accesses
/// are ordered if a chain of dependencies, as defined by the Vulkan specification, leads from one to the other. After a
/// write, the chain must contain a dependency that makes the write available and one that makes it visible.
///
/// It proves that a plan which `fg::verify` accepts has no hazard. `fg::verify` replays frames and keeps a state for
/// each piece of memory. This function searches a chain for each pair on its own instead, and shares no code with it
/// except the table of accesses (verify_rules.h). It checks order and memory dependencies, not contents.
/// @return the pairs as text
std::vector<std::string> unorderedAccesses(const GraphDesc& graph, const Plan& plan);

}  // namespace fg::test
