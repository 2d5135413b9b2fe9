#pragma once

#include <vulkan/vulkan_core.h>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace walr {

/// Format of a texture that receives the slopes of the light over the normal: 0 where there is no surface, or the fits
/// know no slope.
inline constexpr VkFormat kLightDirectionFormat = VK_FORMAT_R32G32_UINT;

/// The slopes in a texel, as integration/include/walr/light_direction.glsl unpacks them in shaders.
/// @returns column i: change of the light, linear RGB, over that of the normal's component i, view space
glm::mat3 lightSlopes(glm::uvec2 texel);

}  // namespace walr
