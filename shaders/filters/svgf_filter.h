#ifndef WALR_SHADERS_FILTERS_SVGF_FILTER_H
#define WALR_SHADERS_FILTERS_SVGF_FILTER_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// The edge-stopping functions that the variance estimate and the a-trous iterations share.
struct SvgfFilterConstants {
  float inverseSigmaDepth;  // Per unit of the pixel's depth.
  float sigmaNormal;        // Exponent of the cosine between normals.
  float sigmaLuminance;     // Standard deviations.
  float minHistory;         // History length below which the variance is estimated over the neighbourhood.
};

#ifdef __cplusplus
static_assert(sizeof(SvgfFilterConstants) == 16);
}  // namespace walr
#endif
#endif
