// Share of the coarse fits in the reconstruction (passes/WALR.md, 8). Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_COARSE_SHARE_GLSL
#define WALR_COARSE_SHARE_GLSL

// A share s_0 of the coarse prediction, cut: to save work it falls to 0 between twice `blocks.coarse-least-share`
// and that share. Where it is 0, the coarse fits are not read.
float fadedShare(float share) { return share * clamp(share * constants.inverseCoarseLeastShare - 1.0, 0.0, 1.0); }

// Share s of the coarse prediction where the windows of the fine fits hold `samples` (W) in the mean.
float coarseShare(float samples) {
  return fadedShare(constants.coarseSamples / (samples + constants.coarseSamples));
}

// Whether a fit with this W has converged: the share is 0 for every mean of such fits, whose W halves round by 2^-11.
bool converges(float samples) { return coarseShare((1.0 - exp2(-10.0)) * samples) == 0.0; }

#endif
