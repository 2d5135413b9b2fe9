#pragma once

#include <cstdint>
#include <span>

#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/memory.h"
#include "samples/denoise/gpu_device.h"
#include "samples/host/host_frame.h"
#include "samples/host/host_graph.h"
#include "samples/host/shaders/view_constants.h"

namespace walr::host {

/// State of `ShownPicture` while it is shown.
inline constexpr fg::ExternalState kShown{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

/// The picture in the window: frames write it when they are traced, the window reads it as often as it is drawn.
class ShownPicture {
 public:
  ShownPicture(const GpuDevice& device, fg::Extent extent);

  [[nodiscard]] fg::vk::ExternalImage external() const { return {image_.get(), 0}; }
  [[nodiscard]] const fg::TextureDesc& desc() const { return desc_; }

 private:
  fg::TextureDesc desc_;
  fg::vk::Owned<VkImage> image_;
  fg::vk::MemoryArena memory_;
};

/// The host's frame for a window: one graph, compiled once, that ends in the shown picture.
class LiveFrame {
 public:
  /// @param device, picture  must outlive this
  /// @param method           declares its passes here; not needed afterwards
  LiveFrame(const GpuDevice& device, Denoiser& method, const HostView& view, const ShownPicture& picture,
            std::uint32_t framesInFlight);

  void record(const fg::vk::Frame& recorded, const HostFrame& frame, const ViewConstants& view);

  [[nodiscard]] const fg::Graph& graph() const { return host_.graph; }
  [[nodiscard]] const fg::Plan& plan() const { return plan_; }
  /// Times of the frame last recorded with a slot, which the device must have finished.
  std::span<const fg::vk::PassTime> passTimes(std::uint32_t slot) { return executor_.passTimes(slot); }

 private:
  HostGraph host_;
  fg::Plan plan_;
  fg::vk::Executor executor_;
};

}  // namespace walr::host
