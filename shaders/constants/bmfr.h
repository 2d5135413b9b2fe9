#ifndef WALR_SHADERS_CONSTANTS_BMFR_H
#define WALR_SHADERS_CONSTANTS_BMFR_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct BmfrFitConstants {
  float noiseAmplitude;  // Half width of the uniform noise on every feature but the constant.
  float rankTolerance;   // Root mean square of a feature's part that no earlier feature explains, at or below which it
                         // is left out.
  float extentFloor;     // Smallest half extent a position axis is scaled by, in units of the block's largest.
};

struct BmfrAccumulationConstants {
  float maxHistory;  // History length at which the cumulative mean turns exponential.
};

#ifdef __cplusplus
static_assert(sizeof(BmfrFitConstants) == 12);
static_assert(sizeof(BmfrAccumulationConstants) == 4);
}  // namespace walr
#endif
#endif
