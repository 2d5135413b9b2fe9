// What the coarse fit has to say beside fine ones. Needs: `constants` (BlockRegressionConstants).
#ifndef WALR_COARSE_SHARE_GLSL
#define WALR_COARSE_SHARE_GLSL

// Share of the coarse fit in its mixture with a fine one of so many paths. It fades out where it would count for little:
// leaving it out then saves the work of it.
float coarseShare(float paths) {
  const float share = constants.coarseSamples / (paths + constants.coarseSamples);
  return share * clamp(share / constants.coarseLeastShare - 1.0, 0.0, 1.0);
}

// Whether it is 0 for every mean of fits of so many paths, which halves hold to 2^-11.
bool converges(float paths) { return coarseShare((1.0 - exp2(-10.0)) * paths) == 0.0; }

#endif
