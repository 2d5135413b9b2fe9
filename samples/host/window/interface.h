#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "framegraph/vulkan/timestamps.h"
#include "samples/denoise/device_memory.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/live_frame.h"
#include "samples/host/session.h"
#include "samples/host/window/presenter.h"
#include "samples/host/window/window.h"

namespace walr::host {

/// Measurements of the last frame that the panels show.
struct FrameFacts {
  std::vector<fg::vk::PassTime> passTimes;
  bool deviceTraces = false;     ///< Paths are traced in a pass of the graph, not on the processor.
  TracedRays traced;             ///< On the processor or the device.
  std::uint64_t graphBytes = 0;  ///< Device memory of the frame graph.
  std::uint64_t sceneBytes = 0;  ///< Device memory of the scene that the device traces.
  std::optional<DeviceMemory> memory = std::nullopt;  ///< Of the whole program, if the driver tells it.
  /// Times of the last frames in milliseconds, oldest first.
  std::deque<float> tracingHistory;
  std::deque<float> deviceHistory;
  std::vector<LintFinding> findings;  ///< See `LiveFrame::findings`.
};

/// The user interface beside the image, drawn with Dear ImGui.
class Interface {
 public:
  /// Width of the panel at the right, in pixels.
  static constexpr int kPanelWidth = 420;

  /// @param window  must outlive this
  Interface(const GpuDevice& device, const Window& window, std::uint32_t framesInFlight);
  /// The device must have finished all frames.
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Create the device objects for drawing. Call once, with the render pass of the first presenter.
  void prepare(VkRenderPass renderPass, fg::vk::FrameQueue& queue);
  /// Lay out the panels and take the user's input.
  /// @param place  rectangle of the window that shows the picture
  void update(Session& session, const LiveFrame& live, const FrameFacts& facts, const Rectangle& place);
  /// Draw the panels that `update` laid out.
  static void draw(VkCommandBuffer commandBuffer);

 private:
  void takeCameraInput(Session& session) const;
  void takeEdgeInput(Session& session, const Rectangle& place) const;

  const GpuDevice& device_;
  const Window& window_;
  std::uint32_t framesInFlight_;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
  bool prepared_ = false;
};

}  // namespace walr::host
