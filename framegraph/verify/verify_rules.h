#pragma once

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

/// What the checker knows of Vulkan, written down a second time on purpose: an error in the compiler's table must not
/// hide itself.
namespace fg::check {

struct Use {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 reads = VK_ACCESS_2_NONE;
  VkAccessFlags2 writes = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkFlags usage = 0;  ///< Image or buffer usage, by what is accessed.
};

/// What an access of a texture or of a buffer needs.
Use useOf(Access access, bool texture);

/// Usage without which an image cannot be brought into a layout; none for layouts that ask for nothing.
VkImageUsageFlags usageInLayout(VkImageLayout layout);

/// The stages with those written out that a collective name stands for.
VkPipelineStageFlags2 expanded(VkPipelineStageFlags2 stages);

/// The accesses that write.
VkAccessFlags2 writesOf(VkAccessFlags2 accesses);

}  // namespace fg::check
