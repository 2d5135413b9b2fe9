#pragma once

#include <string_view>

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

namespace fg {

/// Vulkan's stages, access flags, layout and usage flags for one value of `Access`.
struct AccessInfo {
  std::string_view name;  ///< As spelled in `Access`.
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 readMask = VK_ACCESS_2_NONE;   ///< Access flags of the reading part.
  VkAccessFlags2 writeMask = VK_ACCESS_2_NONE;  ///< Access flags of the writing part.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImageUsageFlags imageUsage = 0;    ///< 0 if textures cannot be accessed this way.
  VkBufferUsageFlags bufferUsage = 0;  ///< 0 if buffers cannot be accessed this way.

  [[nodiscard]] bool reads() const { return readMask != VK_ACCESS_2_NONE; }
  [[nodiscard]] bool writes() const { return writeMask != VK_ACCESS_2_NONE; }
  [[nodiscard]] VkAccessFlags2 mask() const { return readMask | writeMask; }
};

/// The properties of an access.
const AccessInfo& accessInfo(Access access);

/// Usage flags that a resource needs for its host's use of it in a state: for the layout and for the accesses of this
/// state, with SHADER_READ and SHADER_WRITE for all that they stand for. MEMORY_READ and MEMORY_WRITE tell no use.
VkImageUsageFlags imageUsageIn(const ExternalState& state);
VkBufferUsageFlags bufferUsageIn(const ExternalState& state);

/// All access flags that write, those of extensions included: a host may hand over what it wrote with one of them, such
/// as motion from optical flow. 0x4000000000 is VK_ACCESS_2_VIDEO_ENCODE_WRITE_BIT_KHR, which older headers hide.
inline constexpr VkAccessFlags2 kWriteAccesses =
    VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT |
    VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
    VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR | VK_ACCESS_2_TRANSFORM_FEEDBACK_WRITE_BIT_EXT |
    VK_ACCESS_2_TRANSFORM_FEEDBACK_COUNTER_WRITE_BIT_EXT | VK_ACCESS_2_COMMAND_PREPROCESS_WRITE_BIT_NV |
    VK_ACCESS_2_MICROMAP_WRITE_BIT_EXT | VK_ACCESS_2_OPTICAL_FLOW_WRITE_BIT_NV |
    VK_ACCESS_2_VIDEO_DECODE_WRITE_BIT_KHR | VkAccessFlags2{0x4000000000};

}  // namespace fg
