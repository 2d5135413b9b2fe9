#pragma once

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/device_context.h"

namespace fg::vk {

/// A barrier over all memory, for what is recorded outside a graph or within one of its passes. Layouts are ignored.
void recordMemoryBarrier(const DeviceContext& device, VkCommandBuffer commandBuffer, const ExternalState& before,
                         const ExternalState& after);

/// Make what copies have written visible to the host, once it has waited for the frame.
void recordHostVisibility(const DeviceContext& device, VkCommandBuffer commandBuffer);

}  // namespace fg::vk
