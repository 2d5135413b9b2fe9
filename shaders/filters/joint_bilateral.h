#ifndef WALR_SHADERS_FILTERS_JOINT_BILATERAL_H
#define WALR_SHADERS_FILTERS_JOINT_BILATERAL_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// Falloff 1 / (2 sigma^2) of the four terms; 0 switches a term off.
struct JointBilateralConstants {
  float position;  // Per squared pixel.
  float colour;    // Per squared mean luminance of the window.
  float normal;    // Per squared radian.
  float plane;     // Per squared sine of the angle to the tangent plane.
};

#ifdef __cplusplus
static_assert(sizeof(JointBilateralConstants) == 16);
}  // namespace walr
#endif
#endif
