#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framegraph/vulkan/pipelines.h"

namespace fg::vk {

/// Parameters of a dispatch besides its pipeline and descriptor set.
struct DispatchCommand {
  std::span<const std::byte> constants;
  std::array<std::uint32_t, 3> groups{};
  VkBuffer indirect = VK_NULL_HANDLE;  ///< Holds the group counts, unless it is null.
  std::uint64_t indirectOffset = 0;
};

/// Bind a pipeline with its descriptor set, which may be null, and dispatch.
void recordDispatch(const DeviceContext& device, VkCommandBuffer commandBuffer, const ComputePipeline& pipeline,
                    VkDescriptorSet set, const DispatchCommand& command);

}  // namespace fg::vk
