#include "samples/host/window/live_frame.h"

#include "framegraph/vulkan/image.h"
#include "samples/host/renderer.h"

namespace walr::host {
namespace {

HostTargets shownTarget() {
  constexpr fg::ExternalState kShownBefore{kShown.stage, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED};
  HostTargets targets;
  targets.display = {kShownBefore, kShown};
  return targets;
}

}  // namespace

ShownPicture::ShownPicture(const GpuDevice& device, fg::Extent extent)
    : desc_{.format = VK_FORMAT_R8G8B8A8_UNORM, .extent = extent},
      image_(fg::vk::createImage(device.device().context(), desc_,
                                 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, "shown picture")),
      memory_(device.device().context(), VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "shown picture") {
  memory_.add(image_.get());
  memory_.allocate();
}

LiveFrame::LiveFrame(const GpuDevice& device, Denoiser& method, const HostView& view, const ShownPicture& picture,
                     std::uint32_t framesInFlight)
    : host_(declareHostGraph(device.device().context(), method, picture.desc().extent, view, shownTarget())),
      plan_(compileFor(device, host_.graph)),
      executor_(device.device().context(), host_.graph.desc(), plan_,
                {.framesInFlight = framesInFlight, .timestamps = device.device().context().timestampBits > 0}) {
  executor_.bind(host_.display, picture.external());
}

void LiveFrame::record(const fg::vk::Frame& recorded, const HostFrame& frame, const ViewConstants& view) {
  uploadFrame(executor_, host_, frame, view);
  executor_.record(recorded.commandBuffer, recorded.slot);
}

}  // namespace walr::host
