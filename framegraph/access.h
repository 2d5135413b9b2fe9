#pragma once

#include <vulkan/vulkan_core.h>

#include "framegraph/graph.h"

namespace fg {

/// What Vulkan must know of one way to touch a resource.
struct AccessInfo {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 readMask = VK_ACCESS_2_NONE;   ///< Access flags of the reading part.
  VkAccessFlags2 writeMask = VK_ACCESS_2_NONE;  ///< Access flags of the writing part.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageUsageFlags imageUsage = 0;    ///< 0 where textures cannot be touched this way.
  VkBufferUsageFlags bufferUsage = 0;  ///< 0 where buffers cannot be touched this way.

  [[nodiscard]] bool reads() const { return readMask != VK_ACCESS_2_NONE; }
  [[nodiscard]] bool writes() const { return writeMask != VK_ACCESS_2_NONE; }
  [[nodiscard]] VkAccessFlags2 mask() const { return readMask | writeMask; }
};

/// Stage, access masks, layout and usage flags of an access.
const AccessInfo& accessInfo(Access access);

}  // namespace fg
