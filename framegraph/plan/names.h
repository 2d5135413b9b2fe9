#pragma once

#include <string>
#include <string_view>

#include "framegraph/plan/plan.h"

/// Names of Vulkan flags and of the frame graph's enumerations, as printed.
namespace fg {

/// "COMPUTE_SHADER|FRAGMENT_SHADER"; "NONE" for no stage.
std::string stageNames(VkPipelineStageFlags2 stages);
/// "SHADER_SAMPLED_READ"; "NONE" for no access.
std::string accessNames(VkAccessFlags2 accesses);
/// "GENERAL"; a number for layouts without a name in the table.
std::string layoutName(VkImageLayout layout);
std::string_view reasonName(BarrierReason reason);
std::string_view lifetimeName(Lifetime lifetime);
/// "SAMPLED|STORAGE"; "NONE" for no usage.
std::string imageUsageNames(VkImageUsageFlags usage);

}  // namespace fg
