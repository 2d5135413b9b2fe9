#ifndef WALR_SHADERS_CONSTANTS_BLOCK_REGRESSION_H
#define WALR_SHADERS_CONSTANTS_BLOCK_REGRESSION_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct BlockRegressionConstants {
  float planeNear;              // Plane distance over depth up to which the weight is 1 (d0).
  float planeFar;               // Plane distance over depth from which the weight is 0 (d1).
  float sdfFraction;            // Share of the stored edge distance that edge tracing dares to step.
  float ridge;                  // Added to the diagonal of the feature covariance.
  float growthErrors;           // Standard errors of difference up to which a block's window grows in full.
  float coarseSigma;            // Standard deviation of the coarse fit's Gaussian window at one path a pixel, cells.
  float coarseNarrowing;        // Power of the paths a pixel by which that window narrows.
  float coarseReach;            // Where that window ends, standard deviations.
  float coarseGrowthErrors;     // As growthErrors, of a cell's window without occlusion.
  float coarseGrowthOcclusion;  // Times ambient occlusion, and 1: what divides these errors.
  float coarseSamples;          // Paths that the coarse fit counts for.
  float coarseLeastShare;  // Share of the mixture at which it is left out; it counts in full from twice as much on.
};

#ifdef __cplusplus
static_assert(sizeof(BlockRegressionConstants) == 48);
}  // namespace walr
#endif
#endif
