#ifndef WALR_SHADERS_REGRESSION_ATROUS_H
#define WALR_SHADERS_REGRESSION_ATROUS_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct AtrousConstants {
  float planeNear;    // Plane distance over depth up to which the weight is 1 (d0).
  float planeFar;     // Plane distance over depth from which the weight is 0 (d1).
  float sdfFraction;  // Share of the stored edge distance that edge tracing steps at once.
  float ridge;        // Added to the diagonal of the feature covariance.
  float noiseRidge;   // Further ridge, times the relative variance of a sample over the sample count.
};

#ifdef __cplusplus
static_assert(sizeof(AtrousConstants) == 20);
}  // namespace walr
#endif
#endif
