#ifndef WALR_SHADERS_CONSTANTS_ANTILAG_H
#define WALR_SHADERS_CONSTANTS_ANTILAG_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

const int kAntilagTile = 8;  // Pixels per axis: a workgroup of the accumulation.

struct AntilagConstants {
  int radius;       // Of the window, tiles.
  float scoreLow;   // Change over its standard error up to which history counts in full.
  float scoreHigh;  // That from which it counts as one sample.
};

#ifdef __cplusplus
static_assert(sizeof(AntilagConstants) == 12);
}  // namespace walr
#endif
#endif
