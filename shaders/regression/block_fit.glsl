// The regression of WALR over blocks (passes/WALR.md, 5): it solves the normal equations of a block's moments
// and makes the fit that is stored.
// Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_BLOCK_FIT_GLSL
#define WALR_BLOCK_FIT_GLSL
#include "regression/block_moments.glsl"
const int kUsedFeatures = kFeatures;
#include "common/cholesky.glsl"
#include "regression/stored_fit.glsl"

// Rounding moments to halves changes each covariance by at most 2^-11 of the root of the product of both variances. A
// ridge of this share of the diagonal keeps every matrix with kFeatures such entries per row positive definite
// (Gershgorin).
const float kRoundingRidge = float(kFeatures) * exp2(-11.0);

// The ridge of each feature, to be added to the diagonal of the covariance matrix. The moments are centred, so that the
// ridge restrains the slopes and not the mean.
float[kFeatures] ridgeOf(BlockMoments m) {
  float ridge[kFeatures];
  for (int i = 0; i < kFeatures; ++i) ridge[i] = constants.ridge + kRoundingRidge * max(m.xx[triangleEntry(i, i)], 0.0);
  return ridge;
}

// Cholesky factor of the covariance matrix with its ridge.
float[kCovariances] factorOf(BlockMoments m) {
  const float ridge[kFeatures] = ridgeOf(m);
  return choleskyFactor(m.xx, ridge, ridge);
}

vec3[kFeatures] slopesOf(BlockMoments m) { return choleskySolve(factorOf(m), m.yx); }

// The fit of a block or cell, `depth` being that of its depth feature. The constant makes up for the rounding of the
// slopes to halves at the means of the features.
StoredFit fitOf(BlockMoments m, float depth) {
  const vec3 slope[kFeatures] = slopesOf(m);
  StoredFit fit;
  float h[16];
  for (int i = 0; i < kFeatures; ++i)
    for (int c = 0; c < 3; ++c) h[3 * i + c] = slope[i][c];
  h[15] = m.samples / kSampleCountUnit;
  for (int i = 0; i < 8; ++i) fit.slope[i / 4][i % 4] = packHalves(h[2 * i], h[2 * i + 1]);
  vec3 constant = m.y;
  for (int i = 0; i < kFeatures; ++i) constant -= slopeOf(fit, i) * m.x[i];
  fit.constant = vec4(constant / kLightUnit, depth);
  return fit;
}

#endif
