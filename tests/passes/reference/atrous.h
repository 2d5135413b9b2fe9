#pragma once

#include "passes/weighted_regression.h"
#include "tests/passes/reference/edge_tracing.h"
#include "tests/passes/reference/regression.h"

namespace walr::reference {

/// What one iteration hands to the next.
struct AtrousState {
  Image<Moments> moments;
  Image<int> distances;  ///< Nearest edge of each pixel's eight traces; at most 31. Empty before the first iteration.
};

/// What happened at one pixel in one iteration.
struct AtrousPixel {
  MergedMoments merged;
  int nearestEdge = 0;     ///< Step of the nearest edge on the eight traces; spacing + 1 if there is none.
  int replaced = 0;        ///< Number of taps that gave way to another on their segment.
  int lost = 0;            ///< Number of taps that gave way to none.
  bool undecided = false;  ///< Whether a tap met an edge, or any sample at all, lay within rounding.
};

/// The moments before the first iteration: each pixel's own sample.
AtrousState sampleMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated);

/// One pixel of iteration `t` (Meunier & Harada 2022, 3.2 and 3.3): merge of nine taps, 3^t pixels apart. The pixel
/// must be a surface.
AtrousPixel atrousPixel(const HostFrame& frame, const Image<Guide>& guides, const AtrousState& state, glm::ivec2 p,
                        std::uint32_t iteration, const WeightedRegressionSettings& settings);

/// One iteration over the whole picture.
AtrousState atrousIteration(const HostFrame& frame, const Image<Guide>& guides, const AtrousState& state,
                            std::uint32_t iteration, Storage storage, const WeightedRegressionSettings& settings);

/// How the averages of an iteration are solved. The ridge goes by their sample count; where that was dropped on the
/// way, each tap of 3^t x 3^t pixels stands for one.
RegularisationSettings regularisationOf(const WeightedRegressionSettings& settings, std::uint32_t iteration);

/// The spatial filter: all iterations and the solve. Pixels without a surface stay as they were.
/// @param storage Quantised: moments are rounded between iterations, not before the solve, and so is the result.
Image<glm::dvec3> weightedRegression(const HostFrame& frame, const Image<Guide>& guides,
                                     const Image<glm::dvec4>& accumulated, Storage storage,
                                     const WeightedRegressionSettings& settings = {});

}  // namespace walr::reference
