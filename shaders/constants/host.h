// What changes from frame to frame in how a host writes its textures: one uniform block, for convert_input.comp.
// C++ makes it with `walr::hostConstants` (passes/convert_inputs.h).
#ifndef WALR_SHADERS_CONSTANTS_HOST_H
#define WALR_SHADERS_CONSTANTS_HOST_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct HostConstants {
  vec2 depthFromDevice;   // View depth = x / (device depth + y).
  float exposure;         // That the host multiplied radiance by.
  float inverseExposure;  // Takes that away.
  ivec2 offset;           // Pixels: first of the host's textures that is denoised; y down.
};

#ifdef __cplusplus
static_assert(sizeof(HostConstants) == 2 * 4 + 2 * 4 + 2 * 4);
}  // namespace walr
#endif
#endif
