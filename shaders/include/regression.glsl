// Weighted linear regression from its moments (walr.txt 3.1): solve for the coefficients, then reconstruct.
#ifndef WALR_REGRESSION_GLSL
#define WALR_REGRESSION_GLSL
#include "finite.glsl"
#include "moments.glsl"

// Relative variance of one input sample over the window.
float relativeVariance(Moments m) {
  const float mean = luminance(m.y);
  return mean > 0.0 ? max(m.luma2 / (mean * mean) - 1.0, 0.0) : 0.0;
}

// Fitted colour at `features` from the Cholesky factor of the covariance of the features (algorithms 1 and 2). With the
// constant as first feature the decomposition is that of the centred system, so only its 2x2 block is left to do.
vec3 substitute(Moments m, vec2 features, float c11, float c21, float c22) {
  const vec3 forwardU = m.yu / c11;
  const vec3 forwardV = (m.yv - c21 * forwardU) / c22;
  const vec3 slopeV = forwardV / c22;
  const vec3 slopeU = (forwardU - c21 * slopeV) / c11;
  const vec2 d = features - m.x;
  return max(m.y + slopeU * d.x + slopeV * d.y, vec3(0.0));
}

// Pivots no smaller than `pivotFloor` (algorithm 1's epsilon).
vec3 reconstructWithFloor(Moments m, vec2 features, float pivotFloor) {
  const float c11 = sqrt(max(m.xx.x, pivotFloor));
  const float c21 = m.xx.y / c11;
  return substitute(m, features, c11, c21, sqrt(max(m.xx.z - c21 * c21, pivotFloor)));
}

// A ridge on the diagonal that grows with the noise of the mean, because a slope that the samples do not support is
// worse than none.
vec3 reconstructWithRidge(Moments m, vec2 features, float ridge, float noiseRidge) {
  const float lambda = ridge + (m.samples > 0.0 ? noiseRidge * relativeVariance(m) / m.samples : 0.0);
  const float c11 = sqrt(max(m.xx.x, 0.0) + lambda);
  const float c21 = m.xx.y / c11;
  return substitute(m, features, c11, c21, sqrt(max(m.xx.z + lambda - c21 * c21, lambda)));
}

// The fitted colour, no larger than a half can be.
vec3 reconstruct(Moments m, vec2 features, bool pivotFloor, float ridge, float noiseRidge) {
  const vec3 colour = pivotFloor ? reconstructWithFloor(m, features, ridge)
                                 : reconstructWithRidge(m, features, ridge, noiseRidge);
  return min(colour, vec3(kLargestHalf));
}

#endif
