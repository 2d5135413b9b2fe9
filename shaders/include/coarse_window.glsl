// Gaussian window of the coarse fit. Needs: `constants` (BlockRegressionConstants). Takes constant_id 2.
#ifndef WALR_COARSE_WINDOW_GLSL
#define WALR_COARSE_WINDOW_GLSL

layout(constant_id = 2) const int kCellSize = 8;  // Pixels per axis.

// Of a cell or window of so many paths. Pixels that show no surface count as pixels.
float samplesPerPixel(float paths) { return paths / float(kCellSize * kCellSize); }

// Standard deviation, cells: noise asks for a wider window where there are fewer paths.
float coarseSigma(float samplesPerPixel) {
  return max(constants.coarseSigma * pow(max(samplesPerPixel, 1.0), -constants.coarseNarrowing), 0.5);
}

#endif
