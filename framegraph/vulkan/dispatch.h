#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framegraph/vulkan/pipelines.h"

namespace fg::vk {

/// What a dispatch is told besides what it binds.
struct DispatchCommand {
  std::span<const std::byte> constants;
  std::array<std::uint32_t, 3> groups{};
  VkBuffer indirect = VK_NULL_HANDLE;  ///< Holds the group counts, where it is not null.
  std::uint64_t indirectOffset = 0;
};

/// Bind a pipeline with its descriptor set, which may be null, and dispatch.
void recordDispatch(const DeviceContext& device, VkCommandBuffer commandBuffer, const ComputePipeline& pipeline,
                    VkDescriptorSet set, const DispatchCommand& command);

}  // namespace fg::vk
