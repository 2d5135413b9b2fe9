// The regression of WALR over blocks (passes/WALR.md, 5): it solves the normal equations of a block's moments, and
// stores the fit in twenty-four halves.
// Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_BLOCK_FIT_GLSL
#define WALR_BLOCK_FIT_GLSL
#include "block_storage.glsl"
#include "cholesky.glsl"

// f(X) = colour + sum over features i of slope[i] (X[i] - origin[i]).
struct BlockFit {
  vec3 colour;
  float origin[kFeatures];
  vec3 slope[kFeatures];
  float samples;  // 0: no fit.
};

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

BlockFit fitOf(BlockMoments m) {
  BlockFit fit;
  fit.samples = m.samples;
  fit.slope = slopesOf(m);
  // The origin is the mean as a half holds it, so that rounding in memory is small relative to the colour and not to
  // slope times mean.
  fit.colour = m.y;
  for (int i = 0; i < kFeatures; ++i) {
    fit.origin[i] = unpackHalf2x16(packHalves(m.x[i], 0.0)).x;
    fit.colour += fit.slope[i] * (fit.origin[i] - m.x[i]);
  }
  return fit;
}

vec3 evaluate(BlockFit fit, float x[kFeatures]) {
  vec3 colour = fit.colour;
  for (int i = 0; i < kFeatures; ++i) colour += fit.slope[i] * (x[i] - fit.origin[i]);
  return colour;
}

struct PackedFit {
  uvec4 a, b, c;
};

PackedFit packFit(BlockFit f) {
  return PackedFit(uvec4(packHalves(f.colour.r, f.colour.g), packHalves(f.colour.b, f.samples / kSampleCountUnit),
                         packHalves(f.slope[0].r, f.slope[0].g), packHalves(f.slope[0].b, f.slope[1].r)),
                   uvec4(packHalves(f.slope[1].g, f.slope[1].b), packHalves(f.slope[2].r, f.slope[2].g),
                         packHalves(f.slope[2].b, f.slope[3].r), packHalves(f.slope[3].g, f.slope[3].b)),
                   uvec4(packHalves(f.slope[4].r, f.slope[4].g), packHalves(f.slope[4].b, f.origin[0]),
                         packHalves(f.origin[1], f.origin[2]), packHalves(f.origin[3], f.origin[4])));
}

BlockFit unpackFit(PackedFit p) {
  const vec2 a1 = unpackHalf2x16(p.a.y), a3 = unpackHalf2x16(p.a.w), b0 = unpackHalf2x16(p.b.x),
             b2 = unpackHalf2x16(p.b.z), c1 = unpackHalf2x16(p.c.y), c2 = unpackHalf2x16(p.c.z),
             c3 = unpackHalf2x16(p.c.w);
  BlockFit f;
  f.colour = vec3(unpackHalf2x16(p.a.x), a1.x);
  f.samples = kSampleCountUnit * a1.y;
  f.slope = vec3[](vec3(unpackHalf2x16(p.a.z), a3.x), vec3(a3.y, b0), vec3(unpackHalf2x16(p.b.y), b2.x),
                   vec3(b2.y, unpackHalf2x16(p.b.w)), vec3(unpackHalf2x16(p.c.x), c1.x));
  f.origin = float[](c1.y, c2.x, c2.y, c3.x, c3.y);
  return f;
}

#endif
