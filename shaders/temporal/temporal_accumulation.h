#ifndef WALR_SHADERS_TEMPORAL_TEMPORAL_ACCUMULATION_H
#define WALR_SHADERS_TEMPORAL_TEMPORAL_ACCUMULATION_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

const float kMostAccumulatedSamples = 480.0;  // The largest history length that packed light holds (packed_light.glsl).
const float kLengthRounding = 1.125f;  // Packing makes a history length at most this many times as long.

struct TemporalAccumulationConstants {
  float maxHistory;        // History length, frames, at which the cumulative mean turns exponential.
  float maxHistoryAtRest;  // The same of pixels at rest.
  float planeTolerance;    // Largest plane distance of a history tap, in units of its depth.
  float normalThreshold;   // Smallest cosine between geometric normals.
};

#ifdef __cplusplus
static_assert(sizeof(TemporalAccumulationConstants) == 16);
}  // namespace walr
#endif
#endif
