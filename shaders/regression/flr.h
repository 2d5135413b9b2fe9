#ifndef WALR_SHADERS_REGRESSION_FLR_H
#define WALR_SHADERS_REGRESSION_FLR_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// Vectors of a cell that the first buffer of products holds. With eight guides there is a second one, because every
// device takes only buffers of 128 MiB, which those of a picture of 3840 x 2160 would not fit as one. With cells of
// 4 x 4 pixels the first one is as large as what a frame keeps of the last one's light and surfaces, and can take their
// memory.
const int kMostFirstVectors = 14;

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
