#ifndef WALR_SHADERS_REGRESSION_BLOCK_REGRESSION_H
#define WALR_SHADERS_REGRESSION_BLOCK_REGRESSION_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// Threads of block_moments.comp for one block. They lie in a row.
const int kThreadsPerBlock = 4;

// Made of BlockRegressionSettings, which have each constant's meaning and source, for an image and its light
// (`gridOf` in passes/regression/block_regression.cpp).
struct BlockRegressionConstants {
  float planeOffset;              // The edge-stopping function e of a plane distance over depth d is
  float planeScale;               // planeOffset - planeScale * d, clamped to 0..1: 1 at planeNear, 0 at planeFar.
  float sdfFraction;              // Share of the stored edge distance that edge tracing steps at once.
  float ridge;                    // Added to the diagonal of the feature covariance.
  float growthErrors;             // Standard errors up to which a block's window takes in another block in full.
  float coarseSigma;              // Standard deviation of the coarse window at 1 sample per texel of light, cells.
  float coarseNarrowing;          // That window narrows with this power of the samples per texel.
  float coarseReach;              // Distance at which that window ends, standard deviations.
  float coarseGrowthErrors;       // As growthErrors, for the window of a cell without occlusion.
  float coarseGrowthOcclusion;    // These errors are divided by 1 + this x ambient occlusion.
  float coarseSamples;            // W_0 of passes/WALR.md: samples that the coarse fit counts for.
  float inverseCoarseLeastShare;  // 1 over the share of the mixture below which the coarse fit is left out; from twice
                                  // that share on, it is mixed in full.
  float residualGain;             // What the fits miss, over what the agreement of two halves of the light says.
  float residualEdgeGain;         // The same for means over pixels beside an edge.
  float residualLeastShare;       // Share of the accumulated light below which it is left out.
  float lightShare;               // Share of the pixels that accumulated light has a texel for.
  float maxHistory;               // Frames: the longest history of accumulation. Read with kAntilag only.
};

#ifdef __cplusplus
static_assert(sizeof(BlockRegressionConstants) == 68);
}  // namespace walr
#endif
#endif
