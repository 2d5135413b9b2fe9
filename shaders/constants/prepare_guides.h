#ifndef WALR_SHADERS_CONSTANTS_PREPARE_GUIDES_H
#define WALR_SHADERS_CONSTANTS_PREPARE_GUIDES_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct PrepareGuidesConstants {
  float albedoThreshold;   // A pixel whose albedo is below it in every channel has no diffuse lobe.
  float tangentTolerance;  // Largest error of extrapolated inverse depth, relative to inverse depth.
  float normalAgreement;   // Cosine to the shading normal below which the geometric normal is rejected.
  float occlusionRadius;   // Search radius for occluders, pixels.
};

#ifdef __cplusplus
static_assert(sizeof(PrepareGuidesConstants) == 16);
}  // namespace walr
#endif
#endif
