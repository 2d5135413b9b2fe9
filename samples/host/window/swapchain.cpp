#include "samples/host/window/swapchain.h"

#include <algorithm>
#include <array>
#include <limits>

#include "framegraph/vulkan/error.h"

namespace walr::host {
namespace {

using fg::vk::check;

VkSemaphore makeSemaphore(VkDevice device) {
  VkSemaphoreCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  check(vkCreateSemaphore(device, &info, nullptr, &semaphore), "creating a semaphore");
  return semaphore;
}

}  // namespace

Swapchain::Swapchain(const GpuDevice& device, VkSurfaceKHR surface, fg::Extent wanted, std::uint32_t framesInFlight)
    : physical_(device.physical().handle),
      device_(device.device().context().view.device),
      queue_(device.device().queue()) {
  VkBool32 supported = VK_FALSE;
  const std::uint32_t family = device.device().context().view.queueFamily;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(physical_, family, surface, &supported), "querying presentation support");
  if (supported == VK_FALSE) {
    throw fg::vk::Unsupported("device '" + device.name() +
                              "' cannot present to this window: choose another with --device, or run with --headless");
  }
  chooseFormat(surface);
  create(surface, wanted);
  std::uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device_, handle_, &count, nullptr), "querying a swapchain's images");
  images_.resize(count);
  check(vkGetSwapchainImagesKHR(device_, handle_, &count, images_.data()), "querying a swapchain's images");
  for (VkImage image : images_) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format_.format;
    info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(vkCreateImageView(device_, &info, nullptr, &view), "creating a view of a swapchain's image");
    views_.push_back(view);
    rendered_.push_back(makeSemaphore(device_));
  }
  for (std::uint32_t slot = 0; slot < framesInFlight; ++slot) {
    acquired_.push_back(makeSemaphore(device_));
  }
}

Swapchain::~Swapchain() {
  // A frame's fence covers its command buffers, but not its presentation, which waits for a semaphore.
  vkQueueWaitIdle(queue_);
  for (VkImageView view : views_) {
    vkDestroyImageView(device_, view, nullptr);
  }
  for (const std::vector<VkSemaphore>* semaphores : {&acquired_, &rendered_}) {
    for (VkSemaphore semaphore : *semaphores) {
      vkDestroySemaphore(device_, semaphore, nullptr);
    }
  }
  vkDestroySwapchainKHR(device_, handle_, nullptr);
}

void Swapchain::chooseFormat(VkSurfaceKHR surface) {
  std::uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical_, surface, &count, nullptr), "querying a window's formats");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(physical_, surface, &count, formats.data()),
        "querying a window's formats");
  // Values are sRGB-encoded already, so an sRGB format would encode them twice.
  constexpr std::array kWanted = {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
  const auto found = std::ranges::find_first_of(
      formats, kWanted, [](const VkSurfaceFormatKHR& have, VkFormat want) { return have.format == want; });
  if (found == formats.end()) {
    throw fg::vk::Unsupported("the window supports neither B8G8R8A8_UNORM nor R8G8B8A8_UNORM: run with --headless");
  }
  format_ = *found;
}

void Swapchain::create(VkSurfaceKHR surface, fg::Extent wanted) {
  VkSurfaceCapabilitiesKHR capabilities{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(physical_, surface, &capabilities), "querying a window's size");
  constexpr std::uint32_t kProgramChooses = std::numeric_limits<std::uint32_t>::max();
  VkExtent2D extent = capabilities.currentExtent;
  if (extent.width == kProgramChooses) {
    extent.width = std::clamp(wanted.width, capabilities.minImageExtent.width, capabilities.maxImageExtent.width);
    extent.height = std::clamp(wanted.height, capabilities.minImageExtent.height, capabilities.maxImageExtent.height);
  }
  extent_ = {extent.width, extent.height};

  VkSwapchainCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = surface;
  info.minImageCount = capabilities.minImageCount + 1;
  if (capabilities.maxImageCount > 0) {
    info.minImageCount = std::min(info.minImageCount, capabilities.maxImageCount);
  }
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = capabilities.currentTransform;
  info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  check(vkCreateSwapchainKHR(device_, &info, nullptr, &handle_), "creating a swapchain");
}

std::optional<std::uint32_t> Swapchain::acquire(std::uint32_t slot) {
  std::uint32_t image = 0;
  const VkResult result = vkAcquireNextImageKHR(device_, handle_, std::numeric_limits<std::uint64_t>::max(),
                                                acquired_[slot], VK_NULL_HANDLE, &image);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    return std::nullopt;
  }
  if (result != VK_SUBOPTIMAL_KHR) {
    check(result, "acquiring an image of the window");
  }
  return image;
}

bool Swapchain::present(std::uint32_t image) {
  VkPresentInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &rendered_[image];
  info.swapchainCount = 1;
  info.pSwapchains = &handle_;
  info.pImageIndices = &image;
  const VkResult result = vkQueuePresentKHR(queue_, &info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) {
    return false;
  }
  check(result, "presenting an image");
  return true;
}

}  // namespace walr::host
