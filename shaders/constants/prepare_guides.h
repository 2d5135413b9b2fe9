#ifndef WALR_SHADERS_CONSTANTS_PREPARE_GUIDES_H
#define WALR_SHADERS_CONSTANTS_PREPARE_GUIDES_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct PrepareGuidesConstants {
  float albedoThreshold;   // Below it in every channel a pixel has no diffuse lobe.
  float tangentTolerance;  // Largest misfit of extrapolated inverse depth, in units of inverse depth.
  float normalAgreement;   // Cosine to the shading normal below which a geometric normal is not believed.
  float occlusionRadius;   // Pixels that the search for occluders reaches.
};

#ifdef __cplusplus
static_assert(sizeof(PrepareGuidesConstants) == 16);
}  // namespace walr
#endif
#endif
