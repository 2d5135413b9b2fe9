// What changes from frame to frame and is the same for every pass: one uniform block, written by the host.
#ifndef WALR_SHADERS_CONSTANTS_FRAME_H
#define WALR_SHADERS_CONSTANTS_FRAME_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct FrameConstants {
  mat4 view;          // World to view space of this frame; the camera looks down -Z.
  mat4 previousView;  // World to view space of the previous frame.
  mat4 projection;    // View to clip space without jitter, x right, y up, as in OpenGL; only x, y, w are used.
  vec2 jitter;          // Pixels, this frame's sample position minus the pixel centre, y down.
  vec2 previousJitter;  // Pixels, the previous frame's.
  vec2 motionScale;     // Multiplies motion.xy; the result is pixels, previous = current + motion, y down.
  uint frameIndex;      // Counts frames; seeds the replacement hashes.
  float skyDepth;       // Scene units: what is deeper is sky.
};

#ifdef __cplusplus
static_assert(sizeof(FrameConstants) == 3 * 64 + 32);
}  // namespace walr
#endif
#endif
