#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/timestamps.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/session.h"
#include "samples/host/window/presenter.h"
#include "samples/host/window/window.h"

namespace walr::host {

/// What the panels tell of the last frame.
struct FrameFacts {
  std::vector<fg::vk::PassTime> passTimes;
  double tracingSeconds = 0.0;
};

/// The user interface over the picture, by Dear ImGui.
class Interface {
 public:
  /// Width of the panel at the right, pixels.
  static constexpr int kPanelWidth = 420;

  /// @param window  must outlive this
  Interface(const GpuDevice& device, const Window& window, std::uint32_t framesInFlight);
  /// The device must have finished.
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Make what draws; once, with the first presenter.
  void prepare(VkRenderPass renderPass, fg::vk::FrameQueue& queue);
  /// Lay out the panels and take the user's input.
  void update(Session& session, const fg::Graph& graph, const fg::Plan& plan, const FrameFacts& facts);
  /// Draw what `update` laid out.
  static void draw(VkCommandBuffer commandBuffer);

 private:
  void takeCameraInput(Session& session) const;

  const GpuDevice& device_;
  const Window& window_;
  std::uint32_t framesInFlight_;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
  bool prepared_ = false;
};

}  // namespace walr::host
