#ifndef WALR_SHADERS_TEMPORAL_REFLECTION_MOTION_H
#define WALR_SHADERS_TEMPORAL_REFLECTION_MOTION_H
#include "../common/types.h"
#include "../guides/prepare_guides.h"
#ifdef __cplusplus
namespace walr {
#endif

struct ReflectionMotionConstants {
  float planeTolerance;   // Largest distance between two pixels of one surface from each other's plane, over depth.
  float normalThreshold;  // Smallest cosine between their shading normals.
  float maxHistory;       // Longest history, frames.
  float maxHistoryAtRest;  // The same where the picture is at rest.
  float surfaceFrom;      // Linear roughness from which the light follows the surface alone.
  float historyPerLobe;   // Frames that remain where the reflected ray misses by the half angle of the lobe.
};

// Of passes that also read the host's G-buffer.
struct HostReflectionConstants {
  PrepareGuidesConstants guides;
  ReflectionMotionConstants motion;
};

#ifdef __cplusplus
static_assert(sizeof(ReflectionMotionConstants) == 24);
static_assert(sizeof(HostReflectionConstants) == 104);
}  // namespace walr
#endif
#endif
