#include "tests/passes/reference/atrous.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "tests/passes/reference/hash.h"

namespace walr::reference {
namespace {

constexpr int kLargestDistance = 31;

/// Distance between the taps of an iteration: 3^t pixels, the kernel h_t of Meunier & Harada 2022, 3.2.
int spacingOf(std::uint32_t iteration) {
  int spacing = 1;
  for (std::uint32_t t = 0; t < iteration; ++t) spacing *= 3;
  return spacing;
}

/// Random replacement of a tap that met an edge (Meunier & Harada 2022, 3.3): the step of its replacement, either any
/// before step `edge` or one of the last third.
int replacementStep(const HostFrame& frame, glm::ivec2 p, std::uint32_t iteration, int tap, int edge,
                    TapReplacement replacement) {
  const glm::uvec4 key(p, frame.constants.frameIndex, iteration * 9U + static_cast<std::uint32_t>(tap));
  const int choices = replacement == TapReplacement::Near ? (edge + 2) / 3 : edge;
  const auto pick = static_cast<int>(hashBelow(key, static_cast<std::uint32_t>(choices)));
  return replacement == TapReplacement::Near ? edge - 1 - pick : pick;
}

/// The centre, eight taps and up to eight leaks.
constexpr int kMostParts = 17;

}  // namespace

AtrousState sampleMoments(const Image<Guide>& guides, const Image<glm::dvec4>& accumulated) {
  AtrousState state;
  state.moments = Image<Moments>(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    if (guides[p].depth > 0.0) state.moments[p] = momentsOf(guides[p].features, accumulated[p]);
  });
  return state;
}

AtrousPixel atrousPixel(const HostFrame& frame, const Image<Guide>& guides, const AtrousState& state, glm::ivec2 p,
                        std::uint32_t iteration, const WeightedRegressionSettings& settings) {
  const int spacing = spacingOf(iteration);
  const auto trace = [&](glm::ivec2 direction, int steps) {
    return traceEdge(frame, guides, state.distances, p, direction, steps, settings);
  };
  const auto part = [&](glm::ivec2 q, double weight, double weightError) {
    const Moments& m = state.moments[q];
    return WeightedMoments{m, weight, weightError, iteration == 0 ? sampleError(m) : loadError(m, settings.storage)};
  };

  AtrousPixel result;
  result.nearestEdge = spacing + 1;
  std::array<WeightedMoments, kMostParts> parts;
  parts[0] = part(p, 1.0, 0.0);
  int count = 1;
  for (int tap = 0; tap < 9; ++tap) {
    const glm::ivec2 direction(tap % 3 - 1, tap / 3 - 1);
    if (direction == glm::ivec2(0)) continue;
    int reach = spacing;
    Trace traced = trace(direction, reach);
    result.nearestEdge = std::min(result.nearestEdge, traced.edge);
    result.undecided |= traced.weight.undecided;
    if (traced.weight.weight <= 0.0) {
      const bool isolated = traced.edge == 1;
      if (settings.edgeLeak > 0.0F && isolated && guides.contains(p + direction)) {
        parts[count++] = part(p + direction, double(settings.edgeLeak), 0.0);
      }
      if (settings.replaceTaps == TapReplacement::Off || (isolated && !settings.repeatCentre)) {
        ++result.lost;
        continue;
      }
      ++result.replaced;
      reach = replacementStep(frame, p, iteration, tap, traced.edge, settings.replaceTaps);
      traced = trace(direction, reach);
      result.undecided |= traced.weight.undecided;
      if (traced.weight.weight <= 0.0) {
        reach = 0;
        traced = Trace{};
      }
    }
    const glm::ivec2 q = p + reach * direction;
    const double weight = traced.weight.weight * facing(guides[p], guides[q], settings.edgeStopping);
    // The factor's own error: decoding and multiplying two unit vectors.
    parts[count++] = part(q, weight, traced.weight.error + 16.0 * kFloatRoundoff);
  }
  result.merged = merge(parts.data(), count, kMostParts);
  // With a larger error the bounds of the averages do not hold. Where the merge has no sample at all, rounding may
  // still give it one.
  result.undecided |= result.merged.error[kMomentCount - 1] > 0.5 * result.merged.moments.samples;
  return result;
}

AtrousState atrousIteration(const HostFrame& frame, const Image<Guide>& guides, const AtrousState& state,
                            std::uint32_t iteration, Storage storage, const WeightedRegressionSettings& settings) {
  AtrousState next{Image<Moments>(guides.size()), Image<int>(guides.size())};
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    const AtrousPixel pixel = atrousPixel(frame, guides, state, p, iteration, settings);
    Moments moments = pixel.merged.moments;
    if (!settings.keepSampleCount) moments.samples = moments.samples > 0.0 ? 1.0 : 0.0;
    next.moments[p] = storage == Storage::Quantised ? roundMoments(moments, settings.storage) : moments;
    next.distances[p] = std::min(pixel.nearestEdge, kLargestDistance);
  });
  return next;
}

RegularisationSettings regularisationOf(const WeightedRegressionSettings& settings, std::uint32_t iteration) {
  RegularisationSettings result = settings.regularisation;
  if (!settings.keepSampleCount) result.noiseRidge /= static_cast<float>(std::pow(9.0, iteration));
  return result;
}

Image<glm::dvec3> weightedRegression(const HostFrame& frame, const Image<Guide>& guides,
                                     const Image<glm::dvec4>& accumulated, Storage storage,
                                     const WeightedRegressionSettings& settings) {
  AtrousState state = sampleMoments(guides, accumulated);
  for (std::uint32_t t = 0; t < settings.iterations; ++t) {
    WeightedRegressionSettings iteration = settings;
    const bool last = t + 1 == settings.iterations;
    iteration.keepSampleCount |= last;  // The solve sees the samples of the last iteration.
    state = atrousIteration(frame, guides, state, t, last ? Storage::Exact : storage, iteration);
  }
  Image<glm::dvec3> filtered(guides.size());
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    glm::dvec3& out = filtered[p];
    if (guides[p].depth == 0.0) {
      out = glm::dvec3(accumulated[p]);
      return;
    }
    out = reconstruct(state.moments[p], guides[p].features, regularisationOf(settings, settings.iterations - 1)).colour;
    if (storage == Storage::Quantised) {
      for (int i = 0; i < 3; ++i) out[i] = roundToHalf(out[i]);
    }
  });
  return filtered;
}

}  // namespace walr::reference
