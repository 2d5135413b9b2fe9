#ifndef WALR_SHADERS_CONSTANTS_FLR_H
#define WALR_SHADERS_CONSTANTS_FLR_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct FlrConstants {
  ivec2 cells;  // Size of the grid of downsampled moments.
  int factor;   // Pixels per cell and axis.
  int radius;   // Distance at which the Gaussian ends, cells.
  float sigma;  // Standard deviation of the Gaussian, cells.
  float ridge;  // Added to the diagonal of the feature covariance; see flr_solve.comp.
};

#ifdef __cplusplus
static_assert(sizeof(FlrConstants) == 24);
}  // namespace walr
#endif
#endif
