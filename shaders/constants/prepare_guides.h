#ifndef WALR_SHADERS_CONSTANTS_PREPARE_GUIDES_H
#define WALR_SHADERS_CONSTANTS_PREPARE_GUIDES_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

const uint kMaxOcclusionSteps = 16u;

struct PrepareGuidesConstants {
  float albedoThreshold;   // A pixel whose albedo is below it in every channel has no diffuse lobe.
  float tangentTolerance;  // Largest error of extrapolated inverse depth, relative to inverse depth.
  float normalAgreement;   // Cosine to the shading normal below which the geometric normal is rejected.
  float occlusionRadius;   // Search radius for occluders, pixels.
  float occlusionDistances[kMaxOcclusionSteps];  // Of the steps of the search from its pixel, pixels; whole numbers.
};

#ifdef __cplusplus
static_assert(sizeof(PrepareGuidesConstants) == 80);
}  // namespace walr
#endif
#endif
