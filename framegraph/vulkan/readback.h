#pragma once

#include "framegraph/vulkan/device_context.h"

namespace fg::vk {

/// Make what copies have written visible to the host, once it has waited for the frame.
void recordHostVisibility(const DeviceContext& device, VkCommandBuffer commandBuffer);

}  // namespace fg::vk
