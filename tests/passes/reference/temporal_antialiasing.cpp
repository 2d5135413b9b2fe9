#include "tests/passes/reference/temporal_antialiasing.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace walr::reference {
namespace {

/// Smallest half size of the clipping box around a mean, in YCoCg. With halves it is the rounding of four halves in
/// units of luma; with packed light it is the step of the packed history, in units of the brightest channel.
double leastReach(glm::dvec3 mean, LightStorage storage) {
  if (storage == LightStorage::Half) return 4.0 * kHalfRoundoff * mean.x;
  const glm::dvec3 colour = fromYCoCg(mean);
  return std::exp2(-kResolvedBits + 1) * std::max({colour.r, colour.g, colour.b});
}

/// Mean of the surface pixels around a pixel, and the clipping box about it.
struct Neighbourhood {
  glm::dvec3 mean{0.0};
  glm::dvec3 reach{0.0};       ///< Half size of the clipping box.
  glm::dvec3 reachError{0.0};  ///< Bound of what single precision adds to it.
};

/// Mean mu and half size gamma sigma of the clipping box (passes/WALR.md, 10). Border pixels repeat outside the image.
Neighbourhood neighbourhoodOf(const Image<Guide>& guides, const Image<glm::dvec4>& filtered, glm::ivec2 p, double gamma,
                              const TemporalAntialiasingSettings& settings) {
  const auto radius = static_cast<int>(settings.clipRadius);
  std::vector<glm::dvec3> colours;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const glm::ivec2 q = glm::clamp(p + glm::ivec2(dx, dy), glm::ivec2(0), filtered.size() - 1);
      if (guides[q].depth > 0.0 && filtered[q].w >= 0.0) colours.push_back(toYCoCg(glm::dvec3(filtered[q])));
    }
  }
  const auto count = double(colours.size());
  const glm::dvec3 centre = toYCoCg(glm::dvec3(filtered[p]));
  Neighbourhood n;
  for (const glm::dvec3& c : colours) n.mean += c / count;
  glm::dvec3 variance(0.0);
  glm::dvec3 size(0.0);
  for (const glm::dvec3& c : colours) {
    variance += (c - n.mean) * (c - n.mean) / count;
    size += c * c / count;
  }
  const glm::dvec3 deviation = glm::sqrt(variance);
  const double least = leastReach(n.mean, settings.storage);
  n.reach = glm::max(gamma * deviation, least);
  // The variance is a difference of two averages of at most `size`, each with about one rounding per pixel. The colour
  // transform rounds the colours themselves by a few roundoffs.
  const glm::dvec3 transformError(4.0 * kFloatRoundoff *
                                  (std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z)));
  for (int i = 0; i < 3; ++i) {
    const double error = 2.0 * (count + 3.0) * kFloatRoundoff * size[i] + 4.0 * transformError[i] * std::sqrt(size[i]) +
                         transformError[i] * transformError[i];
    const double deviationError =
        deviation[i] > 0.0 ? std::min(error / deviation[i], std::sqrt(error)) : std::sqrt(error);
    const bool atLeast = gamma * (deviation[i] + deviationError) < least;
    n.reachError[i] = (atLeast ? 0.0 : gamma * deviationError) + 16.0 * kFloatRoundoff * least;
  }
  return n;
}

/// The tests by which history taps show the surface of a pixel.
HistoryTests surfaceTestsOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings) {
  HistoryTests tests = historyTestsOf(settings);
  tests.objects = settings.objectIds && frame.objectId.size() == frame.size();
  return tests;
}

/// Whether history of another surface mixes in, by the tests of the taps that the history follows.
struct Mixed {
  bool found = false;
  bool undecided = false;  ///< Rounding may decide.
};

Mixed mixedHistory(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, const Image<Guide>& previousGuides,
                   const TemporalAntialiasingSettings& settings, bool keptTaps) {
  const HistoryTests tests = surfaceTestsOf(frame, settings);
  const bool tested = tests.rejection != HistoryRejection::None || tests.objects;
  if (!tested || frame.scene.still() || !coversPixelArea(frame, settings)) return {};
  const glm::ivec2 followed = followedPixel(guides, p, reprojectionOf(frame, settings, keptTaps));
  const Reprojection r =
      reproject(frame, guides, followed, {.dilateMotion = settings.dilateMotion, .keepTaps = keptTaps});
  Mixed mixed{.undecided = r.undecided};
  for (const HistoryTap& tap : historyTaps(frame, r, previousGuides, tests)) {
    mixed.found |= !tap.matches;
    mixed.undecided |= tap.undecided;
  }
  return mixed;
}

/// Error bound of a clipped colour in YCoCg, from the errors of the colour and of the box. Clipping scales all
/// components by the smallest ratio reach / offset, so the error of that ratio counts once per offset.
glm::dvec3 clipError(glm::dvec3 offset, const Neighbourhood& n, double colourError) {
  double ratio = 1.0;
  double ratioError = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double size = std::abs(offset[i]);
    if (size + colourError <= n.reach[i] - n.reachError[i]) continue;  // Inside, however it is rounded.
    if (size <= colourError) {
      ratioError = 1.0;
      continue;
    }
    ratio = std::min(ratio, n.reach[i] / size);
    ratioError = std::max(ratioError, (n.reachError[i] + colourError) / (size - colourError));
  }
  return glm::abs(offset) * std::min(ratioError, 1.0) + glm::dvec3(ratio * colourError + colourError);
}

}  // namespace

glm::dvec3 toYCoCg(glm::dvec3 rgb) {
  return {(rgb.r + 2.0 * rgb.g + rgb.b) / 4.0, (rgb.r - rgb.b) / 2.0, (2.0 * rgb.g - rgb.r - rgb.b) / 4.0};
}

glm::dvec3 fromYCoCg(glm::dvec3 yCoCg) {
  const double notGreen = yCoCg.x - yCoCg.z;
  return {notGreen + yCoCg.y, yCoCg.x + yCoCg.z, notGreen - yCoCg.y};
}

glm::dvec3 varianceClip(glm::dvec3 colour, glm::dvec3 mean, glm::dvec3 deviation) {
  const glm::dvec3 offset = colour - mean;
  double shrink = 1.0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(offset[i]) > deviation[i]) shrink = std::min(shrink, deviation[i] / std::abs(offset[i]));
  }
  return mean + shrink * offset;
}

bool coversPixelArea(const HostFrame& frame, const TemporalAntialiasingSettings& settings) {
  return walr::coversPixelArea(settings, frame.scene) && frame.constants.jitterDelta != glm::vec2(0.0F);
}

ReprojectionOptions reprojectionOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings,
                                   bool keptTaps) {
  return {.dilateMotion = settings.dilateMotion,
          .dilateByShortDepth = coversPixelArea(frame, settings),
          .keepTaps = keptTaps};
}

HistoryTests historyTestsOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings) {
  return coversPixelArea(frame, settings) ? HistoryTests{.rejection = HistoryRejection::None}
                                          : surfaceTestsOf(frame, settings);
}

HistoryReading historyReadingOf(const HostFrame& frame, const TemporalAntialiasingSettings& settings) {
  HistoryReading reading{.filter = HistoryFilter::Bicubic};
  if (coversPixelArea(frame, settings)) reading.sharpness = double(settings.historySharpness);
  return reading;
}

glm::dvec3 lightOfFrame(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec4>& filtered,
                        glm::ivec2 p, const TemporalAntialiasingSettings& settings) {
  const auto radius = double(settings.filterRadius);
  if (!coversPixelArea(frame, settings) || radius <= 0.5) return glm::dvec3(filtered[p]);
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const glm::ivec2 q = glm::clamp(p + glm::ivec2(dx, dy), glm::ivec2(0), filtered.size() - 1);
      if (guides[q].depth == 0.0 || filtered[q].w < 0.0) continue;
      const glm::dvec2 offset = glm::dvec2(dx, dy) + glm::dvec2(frame.constants.jitter);
      const double weight = std::max(radius - std::abs(offset.x), 0.0) * std::max(radius - std::abs(offset.y), 0.0);
      sum += weight * glm::dvec3(filtered[q]);
      weights += weight;
    }
  }
  return sum / weights;
}

Image<Accumulated> antialias(const HostFrame& frame, const Image<Guide>& guides, const Image<glm::dvec4>& filtered,
                             const AntialiasingHistory& previous, Storage storage,
                             const TemporalAntialiasingSettings& settings, bool keptTaps) {
  Image<Accumulated> result(frame.size());
  const HistoryTests tests = historyTestsOf(frame, settings);
  const HistoryReading reading = historyReadingOf(frame, settings);
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const bool known = filtered[p].w >= 0.0;
    Accumulated& out = result[p];
    out.mean = glm::dvec3(filtered[p]);
    if (guides[p].depth == 0.0) return;
    const glm::dvec3 current = known ? lightOfFrame(frame, guides, filtered, p, settings) : glm::dvec3(0.0);
    out.mean = current;
    if (known) {
      out.samples = 1.0;
      // Up to four products in YCoCg, whose components are at most the sum of the channels.
      out.error = glm::dvec3(32.0 * kFloatRoundoff * (current.r + current.g + current.b));
    }
    if (previous.guides.pixels().empty()) return;
    const Reprojection r = reproject(frame, guides, p, reprojectionOf(frame, settings, keptTaps));
    const HistorySample history =
        sampleHistory(r, historyTaps(frame, r, previous.guides, tests), previous.resolved, reading);
    out.undecided = history.undecided;
    if (!history.found) return;
    if (!known) {
      out.mean = glm::dvec3(history.value);
      out.samples = history.value.w;
      out.error = glm::dvec3(history.error);
      out.samplesError = history.error.w;
      return;
    }

    const auto gamma = double(settings.clipGamma), edgeGamma = double(settings.edgeClipGamma);
    const Mixed mixed =
        edgeGamma < gamma ? mixedHistory(frame, guides, p, previous.guides, settings, keptTaps) : Mixed{};
    out.undecided |= mixed.undecided;
    const Neighbourhood n = neighbourhoodOf(guides, filtered, p, mixed.found ? edgeGamma : gamma, settings);
    const glm::dvec3 pastYCoCg = toYCoCg(glm::dvec3(history.value));
    const glm::dvec3 clipped = fromYCoCg(varianceClip(pastYCoCg, n.mean, n.reach));
    out.samples = std::min(history.value.w + 1.0, double(settings.maxHistory));
    out.samplesError = history.error.w + 2.0 * kFloatRoundoff * out.samples;
    const double newest = 1.0 / out.samples;
    out.mean = glm::max(clipped + (current - clipped) * newest, 0.0);

    const double colourError = std::max({history.error.r, history.error.g, history.error.b}) +
                               16.0 * kFloatRoundoff * (std::abs(pastYCoCg.x) + std::abs(n.mean.x));
    const glm::dvec3 boxError = clipError(pastYCoCg - n.mean, n, colourError);
    const double channelError = boxError.x + boxError.y + boxError.z;
    out.error += glm::dvec3(channelError) + 8.0 * kFloatRoundoff * (glm::abs(clipped) + glm::abs(current)) +
                 out.samplesError * newest * newest * glm::abs(current - clipped);
    if (storage == Storage::Quantised) {
      for (int i = 0; i < 3; ++i) out.mean[i] = roundToHalf(out.mean[i]);
      out.samples = roundToHalf(out.samples);
    }
  });
  return result;
}

}  // namespace walr::reference
