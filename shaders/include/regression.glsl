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

// Cholesky factor of the covariance of the features. With the constant as first feature the decomposition is that of the
// centred system, so only its 2x2 block is left to do.
struct Factor {
  float c11, c21, c22;
  float smallestPivot;   // Before regularisation.
  float regularisation;  // The ridge or the floor.
};

// Pivots no smaller than `pivotFloor` (algorithm 1's epsilon).
Factor factorWithFloor(Moments m, float pivotFloor) {
  const float c11 = sqrt(max(m.xx.x, pivotFloor));
  const float c21 = m.xx.y / c11;
  const float rest = m.xx.z - c21 * c21;
  return Factor(c11, c21, sqrt(max(rest, pivotFloor)), min(m.xx.x, rest), pivotFloor);
}

// A ridge on the diagonal that grows with the noise of the mean, because a slope that the samples do not support is
// worse than none.
Factor factorWithRidge(Moments m, float ridge, float noiseRidge) {
  const float lambda = ridge + (m.samples > 0.0 ? noiseRidge * relativeVariance(m) / m.samples : 0.0);
  const float c11 = sqrt(max(m.xx.x, 0.0) + lambda);
  const float c21 = m.xx.y / c11;
  return Factor(c11, c21, sqrt(max(m.xx.z + lambda - c21 * c21, lambda)), min(m.xx.x, m.xx.z - c21 * c21), lambda);
}

Factor factorOf(Moments m, bool pivotFloor, float ridge, float noiseRidge) {
  return pivotFloor ? factorWithFloor(m, ridge) : factorWithRidge(m, ridge, noiseRidge);
}

// Coefficients of the two features, by forward and back substitution (algorithm 2).
struct Slopes {
  vec3 u, v;
};

Slopes slopesOf(Moments m, Factor c) {
  const vec3 forwardU = m.yu / c.c11;
  const vec3 forwardV = (m.yv - c.c21 * forwardU) / c.c22;
  Slopes slopes;
  slopes.v = forwardV / c.c22;
  slopes.u = (forwardU - c.c21 * slopes.v) / c.c11;
  return slopes;
}

vec3 fitted(Moments m, Slopes slopes, vec2 features) {
  const vec2 d = features - m.x;
  return m.y + slopes.u * d.x + slopes.v * d.y;
}

// The fitted colour, no less than 0 and no larger than a half can be.
vec3 reconstruct(Moments m, vec2 features, bool pivotFloor, float ridge, float noiseRidge) {
  const Slopes slopes = slopesOf(m, factorOf(m, pivotFloor, ridge, noiseRidge));
  return clamp(fitted(m, slopes, features), vec3(0.0), vec3(kLargestHalf));
}

#endif
