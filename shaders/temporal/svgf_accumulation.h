#ifndef WALR_SHADERS_TEMPORAL_SVGF_ACCUMULATION_H
#define WALR_SHADERS_TEMPORAL_SVGF_ACCUMULATION_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct SvgfAccumulationConstants {
  float maxHistory;        // History length at which the mean of the colour turns exponential.
  float maxMomentHistory;  // The same for the moments of the luminance.
  float planeTolerance;    // Largest plane distance of a history tap, in units of its depth.
  float normalThreshold;   // Smallest cosine between geometric normals.
};

#ifdef __cplusplus
static_assert(sizeof(SvgfAccumulationConstants) == 16);
}  // namespace walr
#endif
#endif
