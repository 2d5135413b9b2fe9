// Growth (passes/WALR.md, 5): a window may take in another block or window if noise explains the difference of their
// light.
#ifndef WALR_BLOCK_GROWTH_GLSL
#define WALR_BLOCK_GROWTH_GLSL

// Growth weight same_k: 1 while two means of luminance differ by at most `errors` standard errors, 0 from twice as many
// on. `variance`: that of the difference. `mean`: the sum of both means, each of which a half holds to a relative
// 2^-11.
float sameLight(float difference, float variance, float mean, float errors) {
  const float rounding = exp2(-11.0) * mean;
  const float error = max(sqrt(variance + rounding * rounding), 1e-30);
  return clamp(2.0 - abs(difference) / (errors * error), 0.0, 1.0);
}

#endif
