#include "tests/passes/reference/history.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace walr::reference {
namespace {

/// History is dropped where the weights of the accepted taps sum to less than this.
constexpr double kLeastWeight = 0.01;

/// Bilinear mean of the accepted taps that hold a sample, with their weights normalised.
HistorySample sampleBilinear(const Reprojection& r, const std::array<HistoryTap, 4>& taps,
                             const Image<glm::dvec4>& previous, bool countEmptyTaps) {
  glm::dvec4 sum(0.0);
  glm::dvec4 least(1e300);
  glm::dvec4 most(-1e300);
  double weightSum = 0.0;
  double accepted = 0.0;
  HistorySample history;
  for (const HistoryTap& tap : taps) {
    history.undecided |= tap.undecided;
    if (!tap.matches) continue;
    accepted += tap.weight;
    if (previous[tap.pixel].w == 0.0) continue;
    const glm::dvec4 value = previous[tap.pixel];
    sum += tap.weight * value;
    weightSum += tap.weight;
    least = glm::min(least, value);
    most = glm::max(most, value);
  }
  history.undecided |= std::abs(weightSum - kLeastWeight) <= 4.0 * r.error;
  history.found = weightSum > kLeastWeight;
  if (!history.found) return history;
  history.value = sum / weightSum;
  // Each weight may err by twice the position's error. In the normalised mean that counts by the taps' differences.
  history.error =
      8.0 * r.error / weightSum * (most - least) + 16.0 * kFloatRoundoff * glm::max(glm::abs(most), glm::abs(least));
  if (countEmptyTaps) {
    history.value.w *= weightSum / accepted;
    history.error.w += 8.0 * r.error / accepted * most.w;
  }
  return history;
}

/// Bicubic colour of the 4x4 pixels around the position; border pixels repeat outside the image. The corners are not
/// read: each continues the plane of its three neighbours. Not found where one of the pixels has no history.
HistorySample sampleBicubic(const Reprojection& r, const Image<glm::dvec4>& previous, double sharpness) {
  const glm::dvec2 base = glm::floor(r.pixel - 0.5);
  const glm::dvec2 f = r.pixel - 0.5 - base;
  const std::array<double, 4> wx = cubicWeights(f.x, sharpness);
  const std::array<double, 4> wy = cubicWeights(f.y, sharpness);
  const auto isOuter = [](int i) { return i == 0 || i == 3; };
  std::array<std::array<glm::dvec4, 4>, 4> values;
  glm::dvec4 least(1e300);
  glm::dvec4 most(0.0);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      if (isOuter(i) && isOuter(j)) continue;
      const glm::ivec2 q = glm::clamp(glm::ivec2(base) + glm::ivec2(i - 1, j - 1), glm::ivec2(0), previous.size() - 1);
      values[j][i] = previous[q];
      least = glm::min(least, previous[q]);
      most = glm::max(most, previous[q]);
    }
  }
  for (const int j : {0, 3}) {
    for (const int i : {0, 3}) {
      const int inI = i == 0 ? 1 : 2;
      const int inJ = j == 0 ? 1 : 2;
      values[j][i] = values[j][inI] + values[inJ][i] - values[inJ][inI];
    }
  }
  glm::dvec4 sum(0.0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) sum += wx[i] * wy[j] * values[j][i];
  HistorySample history;
  history.found = least.w > 0.0;
  history.value = glm::max(sum, 0.0);
  // Each of an axis' four weights changes by at most 1.5 per pixel. Their absolute values sum to `size` at most, and
  // those of the products of both axes to its square.
  const double size = 1.0 + 0.5 * sharpness;
  history.error = 16.0 * size * r.error * (most - least) + 30.0 * size * size * kFloatRoundoff * most;
  return history;
}

}  // namespace

std::array<double, 4> cubicWeights(double f, double sharpness) {
  const double a = -sharpness;
  const auto inner = [a](double x) { return (a + 2.0) * x * x * x - (a + 3.0) * x * x + 1.0; };
  const auto outer = [a](double x) { return a * x * x * x - 5.0 * a * x * x + 8.0 * a * x - 4.0 * a; };
  return {outer(1.0 + f), inner(f), inner(1.0 - f), outer(2.0 - f)};
}

HistorySample sampleHistory(const Reprojection& r, const std::array<HistoryTap, 4>& taps,
                            const Image<glm::dvec4>& previous, const HistoryReading& reading) {
  if (!r.valid) return {};
  HistorySample history = sampleBilinear(r, taps, previous, reading.countEmptyTaps);
  if (reading.filter == HistoryFilter::Bilinear || !history.found) return history;
  // The position decides which four pixels are tested.
  const glm::dvec2 fraction = glm::fract(r.pixel - 0.5);
  for (int axis = 0; axis < 2; ++axis) {
    const double toPixel = std::min(fraction[axis], 1.0 - fraction[axis]);
    history.undecided |= toPixel > 0.0 && toPixel <= 2.0 * r.error;
  }
  const bool allMatch = std::all_of(taps.begin(), taps.end(), [](const HistoryTap& tap) { return tap.matches; });
  if (!allMatch) return history;
  const HistorySample bicubic = sampleBicubic(r, previous, reading.sharpness);
  if (!bicubic.found) return history;
  history.value = glm::dvec4(glm::dvec3(bicubic.value), history.value.w);
  history.error = glm::dvec4(glm::dvec3(bicubic.error), history.error.w);
  return history;
}

}  // namespace walr::reference
