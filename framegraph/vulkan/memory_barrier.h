#pragma once

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/device_context.h"

namespace fg::vk {

/// Record a global memory barrier, for commands outside a graph or inside one of its passes. Ignores layouts.
void recordMemoryBarrier(const DeviceContext& device, VkCommandBuffer commandBuffer, const ExternalState& before,
                         const ExternalState& after);

/// Make the results of copies visible to the host after it has waited for the frame.
void recordHostVisibility(const DeviceContext& device, VkCommandBuffer commandBuffer);

}  // namespace fg::vk
