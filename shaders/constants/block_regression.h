#ifndef WALR_SHADERS_CONSTANTS_BLOCK_REGRESSION_H
#define WALR_SHADERS_CONSTANTS_BLOCK_REGRESSION_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct BlockRegressionConstants {
  float planeNear;      // Plane distance over depth up to which the weight is 1 (d0).
  float planeFar;       // Plane distance over depth from which the weight is 0 (d1).
  float sdfFraction;    // Share of the stored edge distance that edge tracing dares to step.
  float ridge;          // Added to the diagonal of the feature covariance.
  float coarseSigma;    // Standard deviation of the coarse fit's Gaussian window, cells.
  int coarseRadius;     // Reach of that window, cells.
  float coarseSamples;  // Samples that the coarse fit counts for.
};

#ifdef __cplusplus
static_assert(sizeof(BlockRegressionConstants) == 28);
}  // namespace walr
#endif
#endif
