#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vulkan/vulkan.h>

#include "framegraph/declare/graph.h"
#include "samples/denoise/gpu_device.h"

namespace walr::host {

/// A Vulkan swapchain with the semaphores that acquiring and presenting its images need.
class Swapchain {
 public:
  /// @param device   must outlive the swapchain; created with VK_KHR_swapchain
  /// @param surface  must outlive the swapchain
  /// @param wanted   size of the window in pixels, for surfaces whose size the program determines
  /// @throws fg::vk::Error if the device cannot present to the surface
  Swapchain(const GpuDevice& device, VkSurfaceKHR surface, fg::Extent wanted, std::uint32_t framesInFlight);
  /// The device must no longer use the images.
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// Acquire the next image. Returns nullopt if the window has changed and needs a new swapchain.
  /// @param slot  slot of the frame that will use the image; the device must have finished its previous frame
  std::optional<std::uint32_t> acquire(std::uint32_t slot);
  /// Present an image after the device has signalled `rendered(image)`. Returns false if the window has changed and
  /// needs a new swapchain.
  bool present(std::uint32_t image);

  [[nodiscard]] fg::TextureDesc desc() const { return {.format = format_.format, .extent = extent_}; }
  [[nodiscard]] const std::vector<VkImage>& images() const { return images_; }
  [[nodiscard]] VkImageView view(std::uint32_t image) const { return views_[image]; }
  /// Signalled when the image acquired with a slot may be written.
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
