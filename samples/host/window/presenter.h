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

/// A rectangle of a window, pixels, y down.
struct Rectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// The largest place for a picture within an area, in its middle: a whole multiple of its size, or less than once.
Rectangle fitPicture(fg::Extent picture, const Rectangle& area);

/// Brings the shown picture and the user interface to a window, as a graph of its own that runs as often as the window
/// is drawn, however long a frame takes to trace.
class Presenter {
 public:
  /// @param drawInterface  draws over the window within a render pass compatible with `renderPass`
  Presenter(const GpuDevice& device, VkSurfaceKHR surface, fg::Extent window, const ShownPicture& picture,
            std::uint32_t framesInFlight, std::function<void(VkCommandBuffer)> drawInterface);
  /// The device must have finished.
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  [[nodiscard]] Swapchain& swapchain() { return swapchain_; }
  [[nodiscard]] VkRenderPass renderPass() const { return renderPass_; }
  /// Record the drawing of the window.
  /// @param image  as taken from the swapchain
  /// @param place  of the picture
  void record(const fg::vk::Frame& recorded, std::uint32_t image, const Rectangle& place);

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
  std::uint32_t image_ = 0;  // Of the frame being recorded.
  Rectangle place_;
};

}  // namespace walr::host
