// What changes from frame to frame and is the same for every pass: one uniform block, written by the host.
// C++ makes it with `walr::frameConstants` (passes/frame.h).
#ifndef WALR_SHADERS_CONSTANTS_FRAME_H
#define WALR_SHADERS_CONSTANTS_FRAME_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct FrameConstants {
  mat4 viewFromWorld;           // World to view space of this frame.
  mat4 previousViewFromView;    // View space of this frame to view space of the previous one, for still surfaces.
  vec4 rayFromPixel;            // Ray (x, y, -1) = (pixel * xy + zw, -1): its product with view depth is the position.
  vec4 previousRayFromPixel;    // The same for the previous frame, of whose picture `pixel` is the same part.
  vec2 motionScale;             // Multiplies motion.xy; the result is pixels, previous = current + motion, y down.
  vec2 jitterDelta;             // Pixels: this frame's jitter minus the previous frame's, y down.
  vec2 previousPixelFromPixel;  // Size of the previous picture over that of this one: 1 unless it changed.
  vec2 pixelFromPreviousPixel;  // Takes that back.
  uint frameIndex;              // Counts frames; seeds random picks and roundings.
  float skyDepth;               // Scene units: what is deeper is sky.
};

#ifdef __cplusplus
static_assert(sizeof(FrameConstants) == 2 * 64 + 2 * 16 + 4 * 8 + 2 * 4);
}  // namespace walr
#endif
#endif
