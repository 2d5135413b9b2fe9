#ifndef WALR_SHADERS_GUIDES_PREPARE_GUIDES_H
#define WALR_SHADERS_GUIDES_PREPARE_GUIDES_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

const uint kMaxOcclusionRings = 8u;

struct PrepareGuidesConstants {
  float albedoThreshold;         // A pixel whose albedo is below it in every channel has no diffuse lobe.
  float tangentTolerance;        // Largest error of extrapolated inverse depth, relative to inverse depth.
  float normalAgreement;         // Cosine to the shading normal below which the geometric normal is rejected.
  float inverseOcclusionRadius;  // 1 over the search radius for occluders, pixels.
  // Of the rings of the search for occluders from its pixel, pixels; whole numbers. Rings on the image's axes and on
  // its diagonals take turns.
  float occlusionDistances[kMaxOcclusionRings];
  float inverseOcclusionDistances[kMaxOcclusionRings];  // 1 over them.
};

#ifdef __cplusplus
static_assert(sizeof(PrepareGuidesConstants) == 80);
}  // namespace walr
#endif
#endif
