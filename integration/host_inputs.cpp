#include "integration/host_inputs.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "framegraph/declare/format.h"

namespace walr {
namespace {

constexpr VkFormat kColour = VK_FORMAT_R16G16B16A16_SFLOAT;

/// The number of channels that a float sampler reads from a format; 0 if it cannot. Vulkan's format names list the
/// channels before the numeric format. Of a depth-stencil format, depth comes first and is what is sampled.
std::uint32_t sampledChannels(const fg::FormatInfo& format) {
  for (const std::string_view numeric : {"_SFLOAT", "_UFLOAT", "_UNORM", "_SNORM", "_SRGB"}) {
    const std::size_t end = format.name.find(numeric);
    if (end == std::string_view::npos) continue;
    return static_cast<std::uint32_t>(std::ranges::count_if(format.name.substr(0, end), [](char c) {
      return std::string_view("RGBAD").find(c) != std::string_view::npos;
    }));
  }
  return 0;
}

/// The number of channels of a colour format of unsigned integers; 0 for any other format.
std::uint32_t integerChannels(const fg::FormatInfo& format) {
  const std::string_view channels = format.name.substr(0, format.name.find('_'));
  if (!format.name.substr(channels.size()).starts_with("_UINT")) return 0;
  return static_cast<std::uint32_t>(std::ranges::count_if(
      channels, [](char c) { return std::string_view("RGBA").find(c) != std::string_view::npos; }));
}

[[noreturn]] void refuseFormat(const HostInput& input, VkFormat format, std::string_view what, std::uint32_t channels) {
  throw std::invalid_argument("input '" + std::string(input.name) + "' cannot be of format " +
                              std::string(fg::formatInfo(format).name) + " (" + std::to_string(format) +
                              "): it takes a format that is " + std::string(what) + " with " +
                              std::to_string(channels) + (channels == 1 ? " channel" : " channels") +
                              " or more, such as " + std::string(fg::formatInfo(input.format).name));
}

}  // namespace

const std::array<HostInput, 10> kHostInputs{{
    {kLightingName, &DenoiserInputs::lighting, kColour, 3,
     "Noisy diffuse indirect radiance without the first hit's albedo, linear, 1 sample per pixel"},
    {"depth", &DenoiserInputs::depth, VK_FORMAT_R32_SFLOAT, 1,
     "Linear view depth (-z of view space) in scene units; sky at or beyond the frame's sky depth"},
    {"normal", &DenoiserInputs::normal, kColour, 3, "Unit shading normal in view or world space; zero on sky"},
    {"motion", &DenoiserInputs::motion, kColour, 3,
     "xy: where the surface was in the previous frame, minus where it is; z: previous minus current view depth"},
    {"albedo", &DenoiserInputs::albedo, kColour, 3,
     "Diffuse albedo of the first hit; pixels without any are passed through", false, HostInput::Of::DiffuseLight},
    {"object_id", &DenoiserInputs::objectId, VK_FORMAT_R32_UINT, 1,
     "Number of the object that the pixel shows, the same from frame to frame; 0xffffffff: none", true},
    {kConfidenceName, &DenoiserInputs::confidence, VK_FORMAT_R8_UNORM, 1,
     "How much of its history a pixel may use: 0 is none, 1 all of it", true},
    {"specular_albedo", &DenoiserInputs::specularAlbedo, kColour, 3,
     "For specular light: directional albedo of the specular lobe; pixels without any are passed through", false,
     HostInput::Of::SpecularLight},
    {"roughness", &DenoiserInputs::roughness, VK_FORMAT_R8_UNORM, 1,
     "For specular light: linear roughness as in glTF, whose square is GGX's alpha", false,
     HostInput::Of::SpecularLight},
    {"specular_motion", &DenoiserInputs::specularMotion, kColour, 3,
     "For specular light: where what is reflected was in the previous frame, minus where it is; world space", true,
     HostInput::Of::SpecularLight},
}};

const HostInput* hostInputNamed(std::string_view name) {
  const auto found = std::ranges::find(kHostInputs, name, &HostInput::name);
  return found == kHostInputs.end() ? nullptr : &*found;
}

void requireInputFormat(const HostInput& input, VkFormat format, std::uint32_t channels) {
  const fg::FormatInfo& info = fg::formatInfo(format);
  const bool integers = integerChannels(fg::formatInfo(input.format)) > 0;
  if ((integers ? integerChannels(info) : sampledChannels(info)) >= channels) return;
  refuseFormat(input, format, integers ? "sampled as unsigned integers" : "sampled as floats", channels);
}

void requireLightFormat(const HostInput& input, VkFormat format, const LightPattern& pattern, bool specular) {
  requireInputFormat(input, format, specular || pattern.hasAlpha() ? 4 : input.channels);
  const bool floats = fg::formatInfo(format).name.find("_SFLOAT") != std::string_view::npos;
  if (floats || !(specular || pattern.counted)) return;
  refuseFormat(input, format,
               specular ? "stored as SFLOAT, because alpha is a distance,"
                        : "stored as SFLOAT, because alpha is a number of samples,",
               4);
}

}  // namespace walr
