#include "samples/host/host_frame.h"

#include <utility>

namespace walr::host {

HostFrame packHostFrame(Frame frame) {
  HostFrame packed;
  packed.extent = {static_cast<std::uint32_t>(frame.depth.width()), static_cast<std::uint32_t>(frame.depth.height())};
  if (!frame.light.everyPixel()) packed.noisyLight = packRgba16(frame.indirect);
  packed.direct = packRgba16(frame.direct);
  packed.emission = packRgba16(frame.emission);
  packed.specular = packSpecular(frame);
  if (frame.reference) {
    packed.referenceDirect = packRgba16(frame.reference->direct);
    packed.referenceIndirect = packRgba16(frame.reference->indirect);
    packed.referenceSpecular = packRgba16(frame.reference->specular);
  }
  packed.constants = frameConstantsOf(frame, glm::vec2(1.0F));
  packed.inputs = packFrame(std::move(frame));
  return packed;
}

HostFrame hostFrameToTrace(Frame frame, gpu_render::TraceData trace) {
  HostFrame host;
  host.extent = {trace.constants.size.x, trace.constants.size.y};
  host.constants = frameConstants(frameDescriptionOf(frame, glm::vec2(1.0F)), host.extent);
  host.inputs.frame = std::move(frame);
  host.trace = std::move(trace);
  return host;
}

}  // namespace walr::host
