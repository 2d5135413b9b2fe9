// Weighted linear regression on two features from its moments (Meunier & Harada 2022, 3.1): solve for the coefficients,
// then reconstruct the colour.
#ifndef WALR_REGRESSION_GLSL
#define WALR_REGRESSION_GLSL
#include "common/finite.glsl"
#include "regression/moments.glsl"

const int kFeatures = 2, kUsedFeatures = kFeatures;
const int kCovariances = 3;
#include "common/cholesky.glsl"

// Relative variance of one input sample over the window.
float relativeVariance(Moments m) {
  const float mean = luminance(m.y);
  return mean > 0.0 ? max(m.luma2 / (mean * mean) - 1.0, 0.0) : 0.0;
}

// Cholesky factor of the covariance of the features. Solving the constant first leaves the centred system, so that only
// its 2 x 2 block has to be decomposed.
struct Factor {
  float l[kCovariances];
  float smallestPivot;   // Before regularisation.
  float regularisation;  // The ridge or the floor.
};

// Regularises with a floor under the pivots (`ridge`: epsilon of algorithm 1), or with a ridge on the diagonal that
// grows with the noise of the mean: a slope that the samples do not support is worse than none.
Factor factorOf(Moments m, bool pivotFloor, float ridge, float noiseRidge) {
  const bool noisy = !pivotFloor && m.samples > 0.0;
  const float lambda = ridge + (noisy ? noiseRidge * relativeVariance(m) / m.samples : 0.0);
  const float added = pivotFloor ? 0.0 : lambda;
  Factor c;
  c.l = choleskyFactor(float[](m.xx.x, m.xx.y, m.xx.z), float[](added, added), float[](lambda, lambda));
  c.smallestPivot = min(m.xx.x, m.xx.z - c.l[1] * c.l[1]);
  c.regularisation = lambda;
  return c;
}

// Coefficients of the two features (Meunier & Harada 2022, algorithm 2).
struct Slopes {
  vec3 u, v;
};

Slopes slopesOf(Moments m, Factor c) {
  const vec3 slopes[kFeatures] = choleskySolve(c.l, vec3[](m.yu, m.yv));
  return Slopes(slopes[0], slopes[1]);
}

vec3 fitted(Moments m, Slopes slopes, vec2 features) {
  const vec2 d = features - m.x;
  return m.y + slopes.u * d.x + slopes.v * d.y;
}

// The fitted colour, clamped to 0 and the largest half.
vec3 reconstruct(Moments m, vec2 features, bool pivotFloor, float ridge, float noiseRidge) {
  const Slopes slopes = slopesOf(m, factorOf(m, pivotFloor, ridge, noiseRidge));
  return clampedRadiance(fitted(m, slopes, features));
}

#endif
