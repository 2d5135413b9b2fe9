#pragma once

#include "passes/regression/weighted_regression.h"
#include "tests/passes/reference/edge_tracing.h"
#include "tests/passes/reference/regression.h"

namespace walr::reference {

/// Result of an iteration, which the next one reads.
struct AtrousState {
  Image<Moments> moments;
  Image<int> distances;  ///< Nearest edge of each pixel's eight traces; at most 31. Empty before the first iteration.
};

/// Result of one iteration at one pixel.
struct AtrousPixel {
  MergedMoments merged;
  int nearestEdge = 0;     ///< Step of the nearest edge on the eight traces; spacing + 1 if there is none.
  int replaced = 0;        ///< Number of taps replaced by another on their segment.
  int lost = 0;            ///< Number of taps dropped without replacement.
  bool undecided = false;  ///< Rounding may decide whether a tap meets an edge, or whether there is any sample.
};

/// The moments before the first iteration, of each pixel alone (Meunier & Harada 2022, 3.2).
AtrousState sampleMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated);

/// Iteration `t` at one pixel (Meunier & Harada 2022, 3.2 and 3.3): the merge of nine taps, 3^t pixels apart. The pixel
/// must show a surface.
AtrousPixel atrousPixel(const HostFrame& frame, const Image<Guide>& guides, const AtrousState& state, glm::ivec2 p,
                        std::uint32_t iteration, const WeightedRegressionSettings& settings);

/// One iteration over the whole image.
AtrousState atrousIteration(const HostFrame& frame, const Image<Guide>& guides, const AtrousState& state,
                            std::uint32_t iteration, Storage storage, const WeightedRegressionSettings& settings);

/// Regularisation settings for the averages of an iteration. The ridge depends on their sample count. Where the
/// iterations drop it (Meunier & Harada 2022, 5.2), each of the 3^t x 3^t pixels of a tap counts as one sample.
RegularisationSettings regularisationOf(const WeightedRegressionSettings& settings, std::uint32_t iteration);

/// The spatial filter (Meunier & Harada 2022, 4.3): all iterations and the solve. Pixels without a surface keep their
/// light.
/// @param storage Quantised: moments are rounded between iterations but not before the solve, and the result is rounded
Image<glm::dvec3> weightedRegression(const HostFrame& frame, const Image<Guide>& guides,
                                     const Image<glm::dvec4>& accumulated, Storage storage,
                                     const WeightedRegressionSettings& settings = {});

}  // namespace walr::reference
