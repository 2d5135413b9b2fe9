// Lighting compared with albedo.
#include <array>
#include <cmath>
#include <cstdio>

#include "passes/lint_judge.h"

namespace walr {
namespace {

/// Mean of the light in a histogram that starts at a word, and the relative variance of that mean.
struct MeanLight {
  MeanLight(const LintCounts& counts, std::uint32_t base, std::uint64_t samples) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t order = 1; order < kLintOrders; ++order) {
      const double light = std::exp2(double(order) - double(kLintUnitOrder));
      sum += double(counts[base + order]) * light;
      squares += double(counts[base + order]) * light * light;
    }
    mean = sum / double(samples);
    relativeVariance = sum > 0.0 ? squares / (sum * sum) : 0.0;
  }
  double mean = 0.0;
  double relativeVariance = 0.0;  ///< Of the mean, by its standard error.
};

}  // namespace

void LintJudge::judgeAlbedo() {
  const std::uint64_t pairs = counts_[kLintPairs];
  if (pairs < kLeastLintSample) return;
  const MeanLight more(counts_, kLintLightMore, pairs);
  const MeanLight less(counts_, kLintLightLess, pairs);
  const MeanLight dividedMore(counts_, kLintDividedMore, pairs);
  const MeanLight dividedLess(counts_, kLintDividedLess, pairs);
  if (!(less.mean > 0.0 && dividedLess.mean > 0.0)) return;
  const double ratio = more.mean / less.mean;
  const double divided = dividedMore.mean / dividedLess.mean;
  // Four standard errors leave noise out. A division by albedo that increases the contrast shows that the difference in
  // light is real, as in dark joints that are also deep.
  const double error = std::sqrt(more.relativeVariance + less.relativeVariance);
  if (std::log(ratio) < 4.0 * error || std::abs(std::log(divided)) > std::log(ratio)) return;
  std::array<char, 128> figures{};
  std::snprintf(figures.data(), figures.size(), "%.2f times the light, and %.2f times after a division by albedo",
                ratio, divided);
  add({"albedo-in-lighting",
       "of " + std::to_string(pairs) +
           " pairs of neighbours on one surface, those with at least twice the albedo have " + figures.data(),
       "albedo was left in the lighting", "divide it out before the denoiser, and multiply it in after"});
}

}  // namespace walr
