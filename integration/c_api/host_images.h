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

/// The host's images of one frame, and the barriers between the host's work and the denoiser's.
namespace walr::api {

/// Arrays of images are ordered like `kHostInputs`, followed by the inputs of a second light, the outputs of both
/// lights, the view, and the history lengths and light directions of both lights.
inline constexpr std::size_t kSecondLightingImage = std::tuple_size_v<decltype(kHostInputs)>;
inline constexpr std::size_t kSecondConfidenceImage = kSecondLightingImage + 1;
inline constexpr std::size_t kOutputImage = kSecondConfidenceImage + 1;
inline constexpr std::size_t kSecondOutputImage = kOutputImage + 1;
inline constexpr std::size_t kViewImage = kSecondOutputImage + 1;
inline constexpr std::size_t kHistoryLengthImage = kViewImage + 1;
inline constexpr std::size_t kLightDirectionImage = kHistoryLengthImage + 1;
inline constexpr std::size_t kSecondHistoryLengthImage = kLightDirectionImage + 1;
inline constexpr std::size_t kSecondLightDirectionImage = kSecondHistoryLengthImage + 1;
inline constexpr std::size_t kImageCount = kSecondLightDirectionImage + 1;

/// Whether the denoiser writes an image.
constexpr bool isWritten(std::size_t index) {
  return index >= kOutputImage;
}

/// Whether an image with a rectangle may be larger than it; the others are exactly as large.
constexpr bool mayHoldRectangle(std::size_t index) {
  return index <= kSecondOutputImage;
}

/// Name of an image in the C API.
std::string_view imageName(std::size_t index);
/// @throws Error naming the unknown port and the known ones
std::size_t imageIndex(std::string_view name);

/// States of the images between `recordAcquire` and `recordRelease`.
extern const HostStates kInnerStates;

/// Requirements of a graph on an image.
struct ImageNeeds {
  bool used = false;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  fg::Extent extent;
  std::optional<std::array<std::uint32_t, 2>> offset =
      {};  ///< First pixel of the extent in the image; absent: sizes are equal.
};

/// A checked image of the host, with defaults filled in.
struct FrameImage {
  bool given = false;
  bool repeated = false;  ///< An earlier input is the same image, in the same states.
  WalrImage image{};
};

/// @throws Error naming the image and what is wrong with it
FrameImage checkedImage(std::size_t index, const WalrImage* image, const ImageNeeds& needs, std::uint32_t queueFamily);

using FrameImages = std::array<FrameImage, kImageCount>;

/// Mark inputs that an earlier input is, too, so that no image is transitioned twice.
/// @throws Error naming both if one is an output, or if their states differ
void markRepeated(FrameImages& images);

/// Record the barriers from the host's work to the denoiser.
void recordAcquire(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images);
/// Record the barriers from the denoiser to the host's work.
void recordRelease(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, const FrameImages& images);

}  // namespace walr::api
