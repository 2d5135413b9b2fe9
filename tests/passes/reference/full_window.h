#pragma once

#include "passes/regression/full_window_regression.h"
#include "tests/passes/reference/atrous.h"

namespace walr::reference {

/// Result of the full window at one pixel.
struct WindowPixel {
  MergedMoments merged;
  Reconstruction fitted;
  bool undecided = false;  ///< Rounding may decide whether there is any sample.
};

/// REFWLR (Meunier & Harada 2022, 6), the spatial filter that WALR approximates: every pixel of the window counts with
/// the smallest value of the edge-stopping function on the straight line to it. There are no a-trous iterations, and
/// taps are not replaced. Pixels without a surface keep their light.
Image<WindowPixel> fullWindowRegression(const HostFrame& frame, const Image<Guide>& guides,
                                        const Image<glm::dvec4>& accumulated, const FullWindowSettings& settings);

/// Moments of a window with all weights 1 (Meunier & Harada 2022, 3.1): plain averages over its pixels inside the
/// image.
Moments boxMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated, glm::ivec2 centre, int window);

}  // namespace walr::reference
