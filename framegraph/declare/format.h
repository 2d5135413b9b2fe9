#pragma once

#include <cstdint>
#include <string_view>

#include <vulkan/vulkan_core.h>

namespace fg {

/// What the frame graph knows of a texel format.
struct FormatInfo {
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::string_view name;            ///< Without prefix: "R16G16B16A16_SFLOAT"; "unknown" for formats not in the table.
  std::uint32_t bytesPerTexel = 0;  ///< Zero for formats not in the table.
  /// Format with at least the same components and range that more devices support in every use; undefined where there
  /// is none.
  VkFormat fallback = VK_FORMAT_UNDEFINED;
};

/// Facts about a format; an entry named "unknown" for those that the frame graph does not know.
const FormatInfo& formatInfo(VkFormat format);

/// Bytes per texel of an uncompressed format, 0 where the format is not known.
std::uint32_t bytesPerTexel(VkFormat format);

}  // namespace fg
