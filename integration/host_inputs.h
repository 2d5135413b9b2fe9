#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "passes/conventions/inputs.h"

namespace walr {

/// One input texture of a denoiser: a member of `DenoiserInputs` with its name.
struct HostInput {
  enum class Of : std::uint8_t { EveryLight, DiffuseLight, SpecularLight };
  std::string_view name;
  fg::Texture DenoiserInputs::*texture;
  VkFormat format;  ///< The usual one. Others are accepted if they have the channels and are sampled as the same type:
                    ///< floats or unsigned integers.
  std::uint32_t channels;  ///< Channels read.
  std::string_view description;
  bool optional = false;  ///< A host need not have it.
  Of of = Of::EveryLight;
};

/// The textures of `DenoiserInputs`.
extern const std::array<HostInput, 10> kHostInputs;

/// The input with a name; null if there is none.
const HostInput* hostInputNamed(std::string_view name);

/// Names of the upload buffer `DenoiserInputs::frame`, of the one with `HostConstants`, and of the first light's
/// textures; those of another light have `LightNames::images` before them.
inline constexpr std::string_view kFrameName = "frame";
inline constexpr std::string_view kHostName = "host";
inline constexpr std::string_view kLightingName = "lighting";
inline constexpr std::string_view kConfidenceName = "confidence";
inline constexpr std::string_view kOutputName = "denoised";
inline constexpr std::string_view kHistoryLengthName = "history_length";
inline constexpr std::string_view kLightDirectionName = "light_direction";
inline constexpr std::string_view kExpectedErrorName = "expected_error";
inline constexpr VkFormat kOutputFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

/// Check that a host's texture can be used as an input.
/// @param channels how many are read, if not `input.channels`
/// @throws std::invalid_argument naming the input, its format and what is accepted
void requireInputFormat(const HostInput& input, VkFormat format, std::uint32_t channels);
inline void requireInputFormat(const HostInput& input, VkFormat format) {
  requireInputFormat(input, format, input.channels);
}
/// The same for the lighting. Its alpha is read where it masks light. Where it is a distance (specular light) or a
/// number of samples, it may be above 1, and the format must be one of floats.
void requireLightFormat(const HostInput& input, VkFormat format, const LightPattern& pattern, bool specular);

}  // namespace walr
