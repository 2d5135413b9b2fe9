#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <vulkan/vulkan.h>

#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "samples/host/live_frame.h"
#include "samples/host/window/swapchain.h"

namespace walr::host {

/// A rectangle of a window, in pixels, y down.
struct Rectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The largest centred rectangle for an image within an area: an integer multiple of the image's size, or, in an area
/// smaller than the image, a fraction of it.
Rectangle fitPicture(fg::Extent picture, const Rectangle& area);

/// Draws the shown picture and the user interface to a window. It has a frame graph of its own, so that the window is
/// redrawn at its own rate, however long a frame takes to trace.
class Presenter {
 public:
  /// @param drawInterface  draws over the window within a render pass compatible with `renderPass`
  Presenter(const GpuDevice& device, VkSurfaceKHR surface, fg::Extent window, const ShownPicture& picture,
            std::uint32_t framesInFlight, std::function<void(VkCommandBuffer)> drawInterface);
  /// The device must have finished all frames.
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  [[nodiscard]] Swapchain& swapchain() { return swapchain_; }
  [[nodiscard]] VkRenderPass renderPass() const { return renderPass_; }
  /// Record the drawing of the window.
  /// @param image  index of the swapchain's image
  /// @param place  rectangle of the window that shows the picture
  /// @param shown  the first columns and rows of the picture, which are shown
  void record(const fg::vk::Frame& recorded, std::uint32_t image, const Rectangle& place, fg::Extent shown);

 private:
  void makeRenderPass();
  void makeFramebuffers();
  fg::Graph declare(const ShownPicture& picture);
  void showPicture(const fg::RecordContext& context, fg::Texture picture);
  void drawInterface(VkCommandBuffer commandBuffer) const;

  const GpuDevice& device_;
  Swapchain swapchain_;
  VkRenderPass renderPass_ = VK_NULL_HANDLE;
  std::vector<VkFramebuffer> framebuffers_;
  std::function<void(VkCommandBuffer)> drawInterface_;
  fg::Texture window_;
  fg::Texture picture_;
  fg::Extent pictureExtent_;
  fg::Graph graph_;
  fg::vk::Executor executor_;
  std::uint32_t image_ = 0;  // Index of the swapchain's image for the frame being recorded.
  Rectangle place_;
  fg::Extent shown_;
};

}  // namespace walr::host
