#pragma once

#include "passes/weighted_regression.h"
#include "tests/passes/reference/atrous.h"

namespace walr::reference {

/// Moments of every pixel's full window with the weights of the edge-stopping function along straight lines, and no
/// a-trous iterations: what REFWLR solves (walr.txt 6).
/// @param window side of the window in pixels, odd
Image<Moments> fullWindowMoments(const HostFrame& frame, const Image<Guide>& guides,
                                 const Image<glm::dvec4>& accumulated, int window,
                                 const WeightedRegressionSettings& settings = {});

/// The spatial filter that WALR approximates: full window, same weights, no replacement.
Image<glm::dvec3> fullWindowRegression(const HostFrame& frame, const Image<Guide>& guides,
                                       const Image<glm::dvec4>& accumulated, int window,
                                       const WeightedRegressionSettings& settings = {});

/// Moments of one window with all weights 1: plain averages over the pixels inside the picture.
Moments boxMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated, glm::ivec2 centre, int window);

}  // namespace walr::reference
