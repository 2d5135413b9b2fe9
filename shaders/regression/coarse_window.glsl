// The Gaussian window of the coarse fit (passes/WALR.md, 6). Needs: `constants` (BlockRegressionConstants). Takes
// constant_id 2.
#ifndef WALR_COARSE_WINDOW_GLSL
#define WALR_COARSE_WINDOW_GLSL

layout(constant_id = 2) const int kCellSize = 8;  // Pixels per axis.

// Samples per pixel of a cell or window with this W. Pixels without a surface count as pixels.
float samplesPerPixel(float samples) { return samples / float(kCellSize * kCellSize); }

// Standard deviation in cells: fewer samples per texel of accumulated light need a wider window.
float coarseSigma(float samplesPerPixel) {
  const float samplesPerTexel = samplesPerPixel / constants.lightShare;
  return max(constants.coarseSigma * pow(max(samplesPerTexel, 1.0), -constants.coarseNarrowing), 0.5);
}

#endif
