// Share of the coarse fits in the reconstruction (passes/WALR.md, 8). Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_COARSE_SHARE_GLSL
#define WALR_COARSE_SHARE_GLSL

// s = S / (W + S), faded to 0 between twice coarseLeastShare and coarseLeastShare: where the coarse fits would count
// for little, they are not read. `samples`: W of the fine fits; S: coarseSamples.
float coarseShare(float samples) {
  const float share = constants.coarseSamples / (samples + constants.coarseSamples);
  return share * clamp(share / constants.coarseLeastShare - 1.0, 0.0, 1.0);
}

// Whether a fit with this W has converged: the share is 0 for every mean of such fits, whose W halves round by 2^-11.
bool converges(float samples) { return coarseShare((1.0 - exp2(-10.0)) * samples) == 0.0; }

#endif
