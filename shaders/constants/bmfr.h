#ifndef WALR_SHADERS_CONSTANTS_BMFR_H
#define WALR_SHADERS_CONSTANTS_BMFR_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

const int kBmfrBlockSize = 32;  // Pixels per axis of a block.

struct BmfrFitConstants {
  float noiseAmplitude;  // Half width of the uniform noise on each feature except the constant.
  float rankTolerance;   // A feature is left out if the root mean square of what earlier features do not explain of it
                         // is at most this.
  float extentFloor;     // Smallest half extent that scales a position axis, in units of the block's largest.
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
