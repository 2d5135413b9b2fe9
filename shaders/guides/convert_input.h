// The uniform block of convert_input.comp: conventions of a host's textures that change from frame to frame.
// C++ makes it with `walr::hostConstants` (passes/guides/convert_inputs.h).
#ifndef WALR_SHADERS_GUIDES_CONVERT_INPUT_H
#define WALR_SHADERS_GUIDES_CONVERT_INPUT_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct HostConstants {
  vec2 depthFromDevice;   // View depth = x / (device depth + y); of an orthographic camera x + y * device depth.
  float exposure;         // The factor by which the host multiplied radiance.
  float inverseExposure;  // 1 / exposure.
  ivec2 offset;           // First pixel of the host's textures that is denoised; y down.
  float standOff;         // Added to the view depth of an orthographic camera (passes/conventions/orthographic.h).
};

#ifdef __cplusplus
static_assert(sizeof(HostConstants) == 2 * 4 + 2 * 4 + 2 * 4 + 4);
}  // namespace walr
#endif
#endif
