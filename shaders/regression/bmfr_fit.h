#ifndef WALR_SHADERS_REGRESSION_BMFR_FIT_H
#define WALR_SHADERS_REGRESSION_BMFR_FIT_H
#include "../common/types.h"
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

#ifdef __cplusplus
static_assert(sizeof(BmfrFitConstants) == 12);
}  // namespace walr
#endif
#endif
