#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "passes/inputs.h"

namespace walr {

/// One texture that a host hands to a denoiser: a member of `DenoiserInputs` by name.
struct HostInput {
  std::string_view name;
  fg::Texture DenoiserInputs::*texture;
  VkFormat format;  ///< The usual one. Any other that is sampled as floats, or as unsigned integers where this one is,
                    ///< and has the channels will do.
  std::uint32_t channels;  ///< Channels read.
  std::string_view description;
  bool optional = false;  ///< A host need not have it.
};

/// The textures of `DenoiserInputs`.
extern const std::array<HostInput, 6> kHostInputs;

/// The input of a name; null where there is none.
const HostInput* hostInputNamed(std::string_view name);

/// Name of the upload buffer `DenoiserInputs::frame`, of the one with `HostConstants`, and of the texture that receives
/// the result.
inline constexpr std::string_view kFrameName = "frame";
inline constexpr std::string_view kHostName = "host";
inline constexpr std::string_view kOutputName = "denoised";
inline constexpr VkFormat kOutputFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

/// Check that a host's texture may stand for an input.
/// @param channels that are read, where they are not `input.channels`
/// @throws std::invalid_argument naming the input, its format and what would do
void requireInputFormat(const HostInput& input, VkFormat format, std::uint32_t channels);
inline void requireInputFormat(const HostInput& input, VkFormat format) {
  requireInputFormat(input, format, input.channels);
}

}  // namespace walr
