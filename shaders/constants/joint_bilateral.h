#ifndef WALR_SHADERS_CONSTANTS_JOINT_BILATERAL_H
#define WALR_SHADERS_CONSTANTS_JOINT_BILATERAL_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

// 1 / (2 sigma^2) of the four terms; 0 switches a term off.
struct JointBilateralConstants {
  float position;  // Over squared pixels.
  float colour;    // Over squared units of the mean luminance of the window.
  float normal;    // Over squared radians.
  float plane;     // Over the squared sine of the angle to the tangent plane.
};

#ifdef __cplusplus
static_assert(sizeof(JointBilateralConstants) == 16);
}  // namespace walr
#endif
#endif
