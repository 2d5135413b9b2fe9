#pragma once

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

/// The verifier's own table of Vulkan's rules. It repeats the compiler's table on purpose, so that an error in one of
/// the two shows.
namespace fg::check {

struct Use {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 reads = VK_ACCESS_2_NONE;
  VkAccessFlags2 writes = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkFlags usage = 0;  ///< Image usage for textures, buffer usage for buffers.
};

/// Stages, accesses, layout and usage flags of an access to a texture or buffer.
Use useOf(Access access, bool texture);

/// Usage flags that an image needs to be in a layout; 0 for layouts that need none.
VkImageUsageFlags usageInLayout(VkImageLayout layout);

/// The stages, with every stage that stands for several (ALL_COMMANDS, ALL_GRAPHICS, PRE_RASTERIZATION_SHADERS,
/// VERTEX_INPUT, ALL_TRANSFER) replaced by those.
VkPipelineStageFlags2 expanded(VkPipelineStageFlags2 stages);

/// The accesses, with every access that stands for several (MEMORY_READ, MEMORY_WRITE, SHADER_READ, SHADER_WRITE)
/// replaced by those.
VkAccessFlags2 expandedAccess(VkAccessFlags2 accesses);

/// Those of the accesses that write, expanded.
VkAccessFlags2 writesOf(VkAccessFlags2 accesses);

}  // namespace fg::check
