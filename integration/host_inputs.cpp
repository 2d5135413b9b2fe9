#include "integration/host_inputs.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "framegraph/format.h"

namespace walr {
namespace {

constexpr VkFormat kColour = VK_FORMAT_R16G16B16A16_SFLOAT;

/// Channels of a format that a float sampler reads, 0 where it reads none. Vulkan's names list the channels before
/// their numeric format; of a depth-stencil format the depth, which comes first, is sampled.
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

}  // namespace

const std::array<HostInput, 5> kHostInputs{{
    {"lighting", &DenoiserInputs::lighting, kColour, 3,
     "Noisy diffuse indirect radiance without the first hit's albedo, linear, 1 sample per pixel"},
    {"depth", &DenoiserInputs::depth, VK_FORMAT_R32_SFLOAT, 1,
     "Linear view depth (-z of view space) in scene units; sky at or beyond the frame's sky depth"},
    {"normal", &DenoiserInputs::normal, kColour, 3, "Unit shading normal in view or world space; zero on sky"},
    {"motion", &DenoiserInputs::motion, kColour, 3,
     "xy: where the surface was in the previous frame, minus where it is; z: previous minus current view depth"},
    {"albedo", &DenoiserInputs::albedo, kColour, 3,
     "Diffuse albedo of the first hit; what has none is passed through as it is"},
}};

void requireInputFormat(const HostInput& input, VkFormat format, std::uint32_t channels) {
  const fg::FormatInfo& info = fg::formatInfo(format);
  if (sampledChannels(info) >= channels) return;
  throw std::invalid_argument("input '" + std::string(input.name) + "' cannot be of format " + std::string(info.name) +
                              " (" + std::to_string(format) + "): it takes a format that is sampled as floats with " +
                              std::to_string(channels) + " channels or more, such as " +
                              std::string(fg::formatInfo(input.format).name));
}

}  // namespace walr
