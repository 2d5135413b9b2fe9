#ifndef WALR_SHADERS_CONSTANTS_AMBIENT_OCCLUSION_H
#define WALR_SHADERS_CONSTANTS_AMBIENT_OCCLUSION_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct AmbientOcclusionConstants {
  float radius;  // Pixels that the search for occluders reaches.
};

#ifdef __cplusplus
static_assert(sizeof(AmbientOcclusionConstants) == 4);
}  // namespace walr
#endif
#endif
