// Gaussian window of the coarse fit. Needs: `settings` (BlockRegressionConstants). Takes constant_id 2.
#ifndef WALR_COARSE_WINDOW_GLSL
#define WALR_COARSE_WINDOW_GLSL

layout(constant_id = 2) const int kCellSize = 8;  // Pixels per axis.

// Of a cell or window of so many paths. Pixels that show no surface count as pixels.
float pathsPerPixel(float paths) { return paths / float(kCellSize * kCellSize); }

// Standard deviation, cells: noise asks for a wider window where there are fewer paths.
float coarseSigma(float pathsPerPixel) {
  return max(settings.coarseSigma * pow(max(pathsPerPixel, 1.0), -settings.coarseNarrowing), 0.5);
}

#endif
