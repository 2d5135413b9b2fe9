#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <walr/walr.h>

#include "framegraph/vulkan/device_context.h"
#include "integration/denoise_graph.h"

/// The host's images of one frame, and the barriers between its work and the denoiser's.
namespace walr::api {

/// Positions of the images in arrays: `kHostInputs` and then the output.
inline constexpr std::size_t kImageCount = std::tuple_size_v<decltype(kHostInputs)> + 1;
inline constexpr std::size_t kOutputImage = kImageCount - 1;

/// Name of an image as the C API's functions take it.
std::string_view imageName(std::size_t index);
/// @throws Error naming the unknown port and the known ones
std::size_t imageIndex(std::string_view name);

/// In which state the graph finds the images after `acquireBarriers` and leaves them before `releaseBarriers`.
extern const HostStates kInnerStates;

/// What an image must be for a graph.
struct ImageNeeds {
  bool used = false;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  fg::Extent extent;
  std::optional<std::array<std::uint32_t, 2>> offset = {};  ///< Where the extent starts in it; absent: it is as large.
};

/// An image as the host gave it, checked, with everything that it left open filled in.
struct FrameImage {
  bool given = false;
  WalrImage image{};
};

/// @throws Error naming the image and what is wrong with it
FrameImage checkedImage(std::size_t index, const WalrImage* image, const ImageNeeds& needs, std::uint32_t queueFamily);

using FrameImages = std::array<FrameImage, kImageCount>;

/// Take the images over from the host's work.
void recordAcquire(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images);
/// Give them back.
void recordRelease(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images);

}  // namespace walr::api
