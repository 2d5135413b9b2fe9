#pragma once

#include "passes/full_window_regression.h"
#include "tests/passes/reference/atrous.h"

namespace walr::reference {

/// What the full window leaves at one pixel.
struct WindowPixel {
  MergedMoments merged;
  Reconstruction fitted;
  bool undecided = false;  ///< Whether there is any sample at all lies within rounding.
};

/// The spatial filter that WALR approximates (REFWLR, Meunier & Harada 2022, 6): every pixel of the window with the
/// smallest weight of the edge-stopping function on the straight line to it; no a-trous iterations and no replacement.
/// Pixels without a surface stay as they were.
Image<WindowPixel> fullWindowRegression(const HostFrame& frame, const Image<Guide>& guides,
                                        const Image<glm::dvec4>& accumulated, const FullWindowSettings& settings);

/// Moments of one window with all weights 1: plain averages over the pixels inside the picture.
Moments boxMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated, glm::ivec2 centre, int window);

}  // namespace walr::reference
