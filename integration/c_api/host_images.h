#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <walr/walr.h>

#include "framegraph/vulkan/device_context.h"
#include "integration/denoise_graph.h"
#include "integration/lights.h"

/// The host's images of one frame, and the barriers between the host's work and the denoiser's.
namespace walr::api {

/// How the denoiser uses an image of a frame.
enum class ImageRole : std::uint8_t {
  Input,       ///< Read.
  Result,      ///< Receives a denoised light.
  Inspection,  ///< Receives a view, history lengths or a light's direction.
};

/// An image of a frame: where the host gives it, and which texture of the graph it is.
struct ImageSlot {
  std::string_view prefix;  ///< `LightNames::images`.
  std::string_view first;   ///< Name of the image of the first light; of an image that lights share, its name.
  const WalrImage* WalrFrame::*given;
  ImageRole role;
  std::size_t light = 0;                            ///< Whose it is; 0 if it is no light's.
  fg::Texture LightImages::*ofLight = nullptr;      ///< Null if it is no light's.
  fg::Texture DenoiserInputs::*ofInputs = nullptr;  ///< Of what the lights share; else null.

  /// In the C API.
  [[nodiscard]] std::string name() const { return std::string(prefix).append(first); }
  /// Invalid if the graph has none.
  [[nodiscard]] fg::Texture textureOf(const DenoiseGraph& graph) const;
};

/// Beside the inputs of the first light, a light has two inputs, a result, history lengths, a direction and an expected
/// error; and there is one view.
inline constexpr std::size_t kImageCount = std::tuple_size_v<decltype(kHostInputs)> + 6 * kMostLights - 2 + 1;

/// All images of a frame. Arrays of images have this order: inputs of the first light, of the others, results, the
/// view, and what else each light writes.
const std::array<ImageSlot, kImageCount>& imageSlots();

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
