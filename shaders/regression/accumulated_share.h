// Constants of the share of the accumulated light in the reconstruction: accumulated_share.glsl and
// residual_statistics.comp.
#ifndef WALR_SHADERS_REGRESSION_ACCUMULATED_SHARE_H
#define WALR_SHADERS_REGRESSION_ACCUMULATED_SHARE_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// Of residual_statistics.comp.
struct ResidualStatisticsConstants {
  int tileOffset;          // Pixels of the first tile that lie before the image, per axis.
  float kept;              // Share of the sums that is left after a frame.
  float keptQuiet;         // The same where tiles are quiet.
  float maxHistory;        // Frames: the longest history of accumulation.
  float innovationGain;    // History shrinks by its length x this x (slope of innovations + innovationBias).
  float innovationBias;    // Minus the slope at which history stays as long as it is.
  float residualGain;      // Factor of the square of what the fits miss, for which it is measured too small.
  float residualEdgeGain;  // The same for means over pixels beside an edge.
  float quietShare;        // Share of accumulated light below which a tile is quiet.
  // Share of accumulated light from which anti-aliasing shortens its history.
  float antialiasingShare;
};

#ifdef __cplusplus
static_assert(sizeof(ResidualStatisticsConstants) == 40);
}  // namespace walr
#endif
#endif
