#include "tests/passes/reference/temporal_accumulation.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "tests/passes/reference/antilag.h"
#include "tests/passes/reference/moments.h"

namespace walr::reference {
namespace {

/// How many samples a frame of a history stands for (passes/WALR.md, 2: kappa).
struct FrameOfHistory {
  double samples = 1.0;
  bool undecided = false;  ///< Rounding decides whether history holds more than as many frames as this one.
};

FrameOfHistory frameOfHistory(const HostFrame& frame, const HistorySample& past, double count, double maxHistory) {
  if (!frame.conventions.light.counted) return {};
  const double assumed = count > 0.0 ? count : 1.0;
  const double full = 9.0 / 8.0 * maxHistory * assumed;
  const double rounding = past.error.w + 4.0 * kFloatRoundoff * full;
  return {past.value.w > full ? past.value.w / maxHistory : assumed, std::abs(past.value.w - full) <= rounding};
}

/// Limit the history length by the antilag factor: min(N_h, kappa (1 - a) M) of passes/WALR.md, 2.
void shorten(HistorySample& past, const Image<double>& antilag, const Reprojection& r, double maxHistory,
             double perFrame, bool hasSample) {
  const Bounded frames = longestHistory(antilag, r.pixel, r.error, maxHistory, hasSample);
  const Bounded longest{perFrame * frames.value, perFrame * frames.error};
  if (past.value.w <= longest.value - longest.error) return;
  past.error.w = std::max(past.error.w, longest.error);
  past.value.w = std::min(past.value.w, longest.value);
}

}  // namespace

Image<Accumulated> accumulate(const HostFrame& frame, const Image<Guide>& guides, const AccumulationHistory& previous,
                              Storage storage, const TemporalAccumulationSettings& settings, bool keepTaps,
                              bool onLightGrid) {
  Image<Accumulated> result(frame.size());
  const TapGrid grid = onLightGrid ? previousLightGrid(frame) : TapGrid();
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (onLightGrid && !hasLightTexel(frame, p)) return;
    const bool sampled = hasSample(frame, p);
    const glm::dvec3 noisy = sampled ? frame.lighting[p] : glm::dvec3(0.0);
    Accumulated& out = result[p];
    if (guides[p].depth == 0.0) {
      if (settings.storage == LightStorage::Half && isFinite(noisy)) out.mean = noisy;
      return;
    }
    // Packed light holds lengths of up to 480.
    const double count =
        sampled && isFinite(noisy) ? std::min(sampleCount(frame, p), 480.0 / double(settings.maxHistory)) : 0.0;
    HistorySample past;
    FrameOfHistory kappa;
    if (!previous.guides.pixels().empty()) {
      const Reprojection r = reproject(frame, guides, p, {.dilateMotion = settings.dilateMotion, .keepTaps = keepTaps});
      past =
          sampleHistory(r, historyTaps(frame, r, previous.guides, historyTestsOf(settings), grid), previous.accumulated,
                        {.filter = settings.historyFilter, .countEmptyTaps = !frame.conventions.light.everyPixel()});
      kappa = frameOfHistory(frame, past, count, settings.maxHistory);
      if (past.found && !previous.antilag.pixels().empty()) {
        shorten(past, previous.antilag, r, settings.maxHistory, kappa.samples, count > 0.0);
      }
    }
    const glm::dvec3 pastMean(past.value);
    out.undecided = past.undecided || kappa.undecided;
    out.samplesError = past.error.w + 2.0 * kFloatRoundoff * past.value.w;
    if (count > 0.0) {
      const glm::dvec3 radiance = glm::clamp(noisy, 0.0, kLargestHalf);
      out.samples = std::min(past.value.w, kappa.samples * (double(settings.maxHistory) - 1.0)) + count;
      const double newest = count / out.samples;
      out.mean = pastMean + (radiance - pastMean) * newest;
      out.error = glm::dvec3(past.error) + 8.0 * kFloatRoundoff * (glm::abs(pastMean) + glm::abs(radiance)) +
                  out.samplesError * newest * newest / count * glm::abs(radiance - pastMean);
      if (past.value.w > 0.0) {
        out.difference = luminance(radiance) - luminance(pastMean);
        out.differenceError = luminance(glm::dvec3(past.error)) +
                              8.0 * kFloatRoundoff * (luminance(radiance) + luminance(glm::abs(pastMean)));
      }
    } else {
      out.samples = std::min(past.value.w, kappa.samples * double(settings.maxHistory));
      out.mean = pastMean;
      out.error = glm::dvec3(past.error);
    }
    if (storage == Storage::Quantised) {
      for (int i = 0; i < 3; ++i) out.mean[i] = roundToFiniteHalf(out.mean[i]);
      out.samples = roundToHalf(out.samples);
    }
  });
  return result;
}

Image<glm::dvec4> meansAndLengths(const Image<Accumulated>& accumulated) {
  Image<glm::dvec4> result(accumulated.size());
  forEachPixel(accumulated.size(),
               [&](glm::ivec2 p) { result[p] = glm::dvec4(accumulated[p].mean, accumulated[p].samples); });
  return result;
}

}  // namespace walr::reference
