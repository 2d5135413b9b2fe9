// The uniform block of a frame, which all passes read and the host writes.
// C++ makes it with `walr::frameConstants` (passes/conventions/frame.h).
#ifndef WALR_SHADERS_CONVENTIONS_FRAME_H
#define WALR_SHADERS_CONVENTIONS_FRAME_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct FrameConstants {
  mat4 viewFromWorld;           // World to view space of this frame.
  mat4 previousViewFromView;    // View space of this frame to view space of the previous one, for still surfaces.
  vec4 rayFromPixel;            // View ray with z = -1: (pixel * xy + zw, -1). Times view depth it is the position.
  vec4 previousRayFromPixel;    // The same for the previous camera, in pixels of this frame's size.
  vec2 motionScale;             // Converts motion.xy to pixels: previous = current + motion, y down.
  vec2 jitterDelta;             // Pixels: this frame's jitter minus the previous frame's, y down.
  vec2 previousPixelFromPixel;  // Size of the previous frame over the size of this one: 1 unless it changed.
  vec2 pixelFromPreviousPixel;  // The inverse.
  vec2 previousTexel;           // 1 over the size of the previous frame, pixels.
  vec2 pixelFromRay;            // 1 over rayFromPixel.xy.
  uint frameIndex;              // Counts frames; seeds random choices and stochastic rounding.
  float skyDepth;               // Scene units: from this view depth on there is sky.
  ivec2 lightOffset;            // Pixels: the pixel of its group that a texel of light belongs to (light_sample.glsl).
  ivec2 previousLightOffset;    // The previous frame's.
  vec2 jitter;                  // Pixels, y down: sample position minus pixel centre, at most 0.5 each way.
};

#ifdef __cplusplus
static_assert(sizeof(FrameConstants) == 2 * 64 + 2 * 16 + 6 * 8 + 2 * 4 + 3 * 8);
}  // namespace walr
#endif
#endif
