// How far windows may grow: what joins a window must show the same light within the error of its mean.
#ifndef WALR_BLOCK_GROWTH_GLSL
#define WALR_BLOCK_GROWTH_GLSL

// Whether two means are of the same light, by how far they lie apart in luminance: 1 up to so many standard errors, 0 from
// twice as many. Halves hold means to 2^-11 of them.
float sameLight(float difference, float variance, float mean, float errors) {
  const float rounding = exp2(-11.0) * mean;
  const float error = max(sqrt(variance + rounding * rounding), 1e-30);
  return clamp(2.0 - abs(difference) / (errors * error), 0.0, 1.0);
}

#endif
