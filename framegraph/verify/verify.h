#pragma once

#include <string>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Check a plan against the declarations by replaying frames on a model of the device. The check shares no code with
/// the compiler, not even its access table.
///
/// The model tracks every buffer and every mip level and layer of every physical image: its layout; the version and
/// frame that it holds; the last write, whether it is available, and the stages and accesses to which it is visible;
/// the reads since; and the resources that share its bytes. Barriers have only the effects that the Vulkan
/// specification gives them, and a stage or access that stands for several counts as those. Vulkan also executes the
/// layout transitions of a queue in their order without a barrier; the verifier does not grant this, because a plan
/// that depends on it names wrong stages, for instance where a release meets the first use in the next frame. Five
/// frames are replayed, so that histories swap roles and memory gets new owners from frame to frame. Histories are
/// reset before the first and the fourth frame. The time is proportional to the accesses and barriers of the plan, as
/// long as a resource's memory passes from few resources to few.
/// @return the faults as text; empty if the plan is correct
std::vector<std::string> verify(const GraphDesc& graph, const Plan& plan);

}  // namespace fg
