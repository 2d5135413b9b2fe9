// Share of the coarse fits in the reconstruction (passes/WALR.md, 8). Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_COARSE_SHARE_GLSL
#define WALR_COARSE_SHARE_GLSL

// Fades a small share s_0 of the coarse prediction to 0. The result equals s_0 from twice `blocks.coarse-least-share`
// on, and is 0 below `blocks.coarse-least-share`. Pixels whose share is 0 need not read the coarse fits.
float fadedShare(float share) { return share * clamp(share * constants.inverseCoarseLeastShare - 1.0, 0.0, 1.0); }

// Share s of the coarse prediction where the windows of the fine fits hold `samples` (W) in the mean.
float coarseShare(float samples) {
  return fadedShare(constants.coarseSamples / (samples + constants.coarseSamples));
}

// Whether a fit with this W has converged: a mean of such fits has a share of 0, even after W was rounded to half
// precision, by 2^-11 at most.
bool converges(float samples) { return coarseShare((1.0 - exp2(-10.0)) * samples) == 0.0; }

#endif
