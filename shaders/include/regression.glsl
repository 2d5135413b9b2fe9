// Weighted linear regression from its moments (walr.txt 3.1): solve for the coefficients, then reconstruct.
#ifndef WALR_REGRESSION_GLSL
#define WALR_REGRESSION_GLSL
#include "moments.glsl"

// Relative variance of one input sample over the window.
float relativeVariance(Moments m) {
  const float mean = luminance(m.y);
  return mean > 0.0 ? max(m.luma2 / (mean * mean) - 1.0, 0.0) : 0.0;
}

// Fitted colour at `features`. Cholesky with the constant as first feature is the solve of the centred system, so only
// the 2x2 block of covariances is decomposed (algorithms 1 and 2). The ridge on its diagonal grows with the noise of
// the mean, because a slope that the samples do not support is worse than none.
vec3 reconstruct(Moments m, vec2 features, float ridge, float noiseRidge) {
  const float lambda = ridge + noiseRidge * relativeVariance(m) / m.samples;
  const float c11 = sqrt(max(m.xx.x, 0.0) + lambda);
  const float c21 = m.xx.y / c11;
  const float c22 = sqrt(max(m.xx.z - c21 * c21, 0.0) + lambda);
  const vec3 forward1 = m.yu / c11;
  const vec3 forward2 = (m.yv - c21 * forward1) / c22;
  const vec3 slopeV = forward2 / c22;
  const vec3 slopeU = (forward1 - c21 * slopeV) / c11;
  const vec2 d = features - m.x;
  return max(m.y + slopeU * d.x + slopeV * d.y, vec3(0.0));
}

#endif
