#include "samples/host/host_frame.h"

#include <utility>

namespace walr::host {

HostFrame packHostFrame(Frame frame) {
  HostFrame packed;
  if (!frame.light.everyPixel()) packed.noisyLight = packRgba16(frame.indirect);
  packed.direct = packRgba16(frame.direct);
  packed.emission = packRgba16(frame.emission);
  if (frame.reference) {
    packed.referenceDirect = packRgba16(frame.reference->direct);
    packed.referenceIndirect = packRgba16(frame.reference->indirect);
  }
  packed.inputs = packFrame(std::move(frame));
  return packed;
}

}  // namespace walr::host
