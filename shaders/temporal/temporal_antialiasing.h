#ifndef WALR_SHADERS_TEMPORAL_TEMPORAL_ANTIALIASING_H
#define WALR_SHADERS_TEMPORAL_TEMPORAL_ANTIALIASING_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct TemporalAntialiasingConstants {
  float maxHistory;        // History length at which the cumulative mean turns exponential.
  float restFactor;        // At rest it is at most so many times as long.
  float clipGamma;         // Half size of the clipping box, standard deviations of the neighbourhood.
  float edgeClipGamma;     // The same where history of another surface mixes in. Read with kTightAtEdges only.
  float filterRadius;      // Half width of the tent over the samples of a jittered frame, pixels.
  float historySharpness;  // Of the bicubic filter that reads the history in a jittered frame. With kPixelArea only.
  float planeTolerance;    // Largest plane distance of a history tap, in units of its depth.
  float normalThreshold;   // Smallest cosine between geometric normals.
};

#ifdef __cplusplus
static_assert(sizeof(TemporalAntialiasingConstants) == 32);
}  // namespace walr
#endif
#endif
