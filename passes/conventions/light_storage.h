#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <vulkan/vulkan_core.h>

namespace walr {

/// How light is stored in a texture between passes.
enum class LightStorage : std::uint32_t {
  Half,    ///< RGBA16F.
  Packed,  ///< R32_UINT: shared exponent, stochastic rounding (packed_light.glsl); surfaces only.
};

inline constexpr std::array<std::string_view, 2> kLightStorages{"half", "packed"};

constexpr VkFormat formatOf(LightStorage storage) {
  return storage == LightStorage::Packed ? VK_FORMAT_R32_UINT : VK_FORMAT_R16G16B16A16_SFLOAT;
}

constexpr LightStorage lightStorageOf(VkFormat format) {
  return format == VK_FORMAT_R32_UINT ? LightStorage::Packed : LightStorage::Half;
}

}  // namespace walr
