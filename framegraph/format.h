#pragma once

#include <cstdint>

#include <vulkan/vulkan_core.h>

namespace fg {

/// Bytes per texel of an uncompressed format, 0 where the format is not known.
std::uint32_t bytesPerTexel(VkFormat format);

}  // namespace fg
