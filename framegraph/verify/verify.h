#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Check a plan against the declarations by replaying frames on a model of the device, sharing no code with the
/// compiler, not even its access table.
///
/// The model knows, for every mip level and layer of every physical image and for every buffer: the layout; which
/// version of which frame it holds; the last write, whether that is available, and to which stages and accesses it is
/// visible; the reads since; and, for every transient, whose bytes it shares. Barriers order and publish only what the
/// Vulkan specification says they do. Five frames are replayed, so that histories swap roles and memory is handed over
/// from frame to frame; histories are reset before the first and the fourth.
/// @return what is wrong, in words; empty where the plan is right
std::vector<std::string> verify(const GraphDesc& graph, const Plan& plan);

}  // namespace fg
