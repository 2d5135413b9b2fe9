#ifndef WALR_SHADERS_REGRESSION_FULL_WINDOW_H
#define WALR_SHADERS_REGRESSION_FULL_WINDOW_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct FullWindowConstants {
  ivec2 begin;      // First pixel of the tile.
  ivec2 end;        // One past its last.
  float planeNear;  // As in AtrousConstants, like the three that follow.
  float planeFar;
  float ridge;
  float noiseRidge;
};

#ifdef __cplusplus
static_assert(sizeof(FullWindowConstants) == 32);
}  // namespace walr
#endif
#endif
