#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vulkan/vulkan.h>

#include "framegraph/declare/graph.h"
#include "samples/denoise/gpu_device.h"

namespace walr::host {

/// The images that a window shows in turn, with what it takes to hand them back and forth.
class Swapchain {
 public:
  /// @param device   must outlive the swapchain; made with VK_KHR_swapchain
  /// @param surface  must outlive the swapchain
  /// @param wanted   size of the window in pixels, for surfaces that leave it to the program
  /// @throws fg::vk::Error where the device cannot show pictures there
  Swapchain(const GpuDevice& device, VkSurfaceKHR surface, fg::Extent wanted, std::uint32_t framesInFlight);
  /// The device must have finished with the images.
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// Take the next image. Nothing when the window has changed: make a new swapchain.
  /// @param slot  of the frame that will use it, which the device has finished with
  std::optional<std::uint32_t> acquire(std::uint32_t slot);
  /// Show an image, once the device has signalled `rendered(image)`. False when the window has changed.
  bool present(std::uint32_t image);

  [[nodiscard]] fg::TextureDesc desc() const { return {.format = format_.format, .extent = extent_}; }
  [[nodiscard]] const std::vector<VkImage>& images() const { return images_; }
  [[nodiscard]] VkImageView view(std::uint32_t image) const { return views_[image]; }
  /// Signalled when the image taken with a slot may be written.
  [[nodiscard]] VkSemaphore acquired(std::uint32_t slot) const { return acquired_[slot]; }
  [[nodiscard]] VkSemaphore rendered(std::uint32_t image) const { return rendered_[image]; }

 private:
  void chooseFormat(VkSurfaceKHR surface);
  void create(VkSurfaceKHR surface, fg::Extent wanted);

  VkPhysicalDevice physical_;
  VkDevice device_;
  VkQueue queue_;
  VkSurfaceFormatKHR format_{};
  fg::Extent extent_;
  VkSwapchainKHR handle_ = VK_NULL_HANDLE;
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  std::vector<VkSemaphore> acquired_;
  std::vector<VkSemaphore> rendered_;
};

}  // namespace walr::host
