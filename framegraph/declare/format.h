#pragma once

#include <cstdint>
#include <string_view>

#include <vulkan/vulkan_core.h>

namespace fg {

/// Properties of a texel format.
struct FormatInfo {
  VkFormat format = VK_FORMAT_UNDEFINED;
  std::string_view name;            ///< Without prefix: "R16G16B16A16_SFLOAT"; "unknown" for formats not in the table.
  std::uint32_t bytesPerTexel = 0;  ///< 0 for formats not in the table.
  /// A format to try on a device that lacks this one: with at least the same components, and a range that is no
  /// smaller; undefined if there is none.
  VkFormat fallback = VK_FORMAT_UNDEFINED;
};

/// The table's entry for a format; an entry named "unknown" if it has none.
const FormatInfo& formatInfo(VkFormat format);

/// Bytes per texel of an uncompressed format; 0 for formats not in the table.
std::uint32_t bytesPerTexel(VkFormat format);

}  // namespace fg
