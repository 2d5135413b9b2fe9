#include "tests/passes/reference/svgf.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/passes/reference/history.h"
#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// Edge-stopping functions of depth and normal (Schied et al. 2017, 4.4) between two pixels, the depth one by distance
/// from the plane of p; 0 where q has no surface.
double surfaceWeight(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                     const SvgfFilterSettings& settings) {
  if (!guides.contains(q) || guides[q].depth == 0.0) return 0.0;
  const auto position = [&](glm::ivec2 pixel) {
    return rayThrough(frame.constants.rayFromPixel, pixelCentre(pixel)) * guides[pixel].depth;
  };
  const double distance = std::abs(glm::dot(guides[p].normal, position(q) - position(p))) / guides[p].depth;
  const double cosine = glm::dot(octahedralDecode(guides[p].features), octahedralDecode(guides[q].features));
  return std::exp(-distance / double(settings.sigmaDepth)) *
         std::pow(std::clamp(cosine, 1e-6, 1.0), double(settings.sigmaNormal));
}

double binomial(int n, int k) {
  return std::round(std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0)));
}

/// Spatial estimate (Schied et al. 2017, 4.2): the luminance's variance over 7x7 pixels, and its second moment about
/// the pixel's own mean.
struct SpatialMoments {
  double variance = 0.0;
  double secondMoment = 0.0;
};

SpatialMoments spatialMoments(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments,
                              glm::ivec2 p, const SvgfFilterSettings& settings) {
  double mean = 0.0;
  double square = 0.0;
  double weightSum = 0.0;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      const glm::ivec2 q = p + glm::ivec2(x, y);
      const double weight = surfaceWeight(frame, guides, p, q, settings);
      if (weight == 0.0 || moments[q].samples == 0.0) continue;
      mean += weight * moments[q].mean;
      square += weight * moments[q].square;
      weightSum += weight;
    }
  }
  mean /= weightSum;
  square /= weightSum;
  const double own = moments[p].mean;
  return {std::max(square - mean * mean, 0.0), square - 2.0 * mean * own + own * own};
}

/// Root of the variance after a 3x3 Gaussian, for the luminance's edge-stopping function (Schied et al. 2017, 4.4).
double smoothDeviation(const Image<Guide>& guides, const Image<SvgfPixel>& input, glm::ivec2 p) {
  double sum = 0.0;
  double weightSum = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      const glm::ivec2 q = glm::clamp(p + glm::ivec2(x, y), glm::ivec2(0), input.size() - 1);
      if (guides[q].depth == 0.0 || input[q].deviation < 0.0) continue;
      const double weight = (2.0 - std::abs(x)) * (2.0 - std::abs(y)) / 16.0;
      sum += weight * input[q].deviation * input[q].deviation;
      weightSum += weight;
    }
  }
  return std::sqrt(sum / weightSum);
}

/// Variance along an axis of the kernel that all iterations form together where no edge stops them.
double kernelVariance(const SvgfFilterSettings& settings) {
  return double(settings.radius) / 2.0 * (std::pow(4.0, settings.iterations) - 1.0) / 3.0;
}

}  // namespace

double SvgfMoments::variance() const {
  return std::max(square - mean * mean, 0.0);
}

Image<SvgfMoments> svgfAccumulate(const HostFrame& frame, const Image<Guide>& guides, const SvgfHistory& history,
                                  const SvgfAccumulationSettings& settings) {
  Image<SvgfMoments> result(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    SvgfMoments& out = result[p];
    const glm::dvec3 noisy = frame.lighting[p];
    if (guides[p].depth == 0.0) {
      out.colour = isFinite(noisy) ? noisy : glm::dvec3(0.0);
      return;
    }
    if (!history.guides.pixels().empty()) {
      const Reprojection r = reproject(frame, guides, p);
      std::array<HistoryTap, 4> taps = historyTaps(frame, r, history.guides,
                                                   {HistoryRejection::Plane, double(settings.thresholds.planeTolerance),
                                                    double(settings.thresholds.normalThreshold)});
      for (HistoryTap& tap : taps) tap.matches = tap.matches && history.moments[tap.pixel].w > 0.0;
      const HistorySample colour = sampleHistory(r, taps, history.colour, {});
      const HistorySample moments = sampleHistory(r, taps, history.moments, {});
      out.colour = glm::dvec3(colour.value);
      out.mean = moments.value.x;
      out.square = moments.value.y;
      out.samples = moments.value.w;
      out.colourError = colour.error;
      out.momentError = moments.error;
      out.undecided = moments.undecided;
    }
    if (!isFinite(noisy)) return;
    const glm::dvec3 radiance = glm::clamp(noisy, 0.0, kLargestHalf);
    const double l = luminance(radiance);
    out.samples = std::min(out.samples + 1.0, double(settings.maxHistory));
    const double momentAlpha = 1.0 / std::min(out.samples, double(settings.maxMomentHistory));
    out.colour += (radiance - out.colour) / out.samples;
    out.mean += (l - out.mean) * momentAlpha;
    out.square += (l * l - out.square) * momentAlpha;
  });
  return result;
}

Image<SvgfMoments> svgfSingleFrame(const HostFrame& frame, const Image<Guide>& guides) {
  return svgfAccumulate(frame, guides, {});
}

Image<SvgfPixel> svgfVariance(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments,
                              const SvgfFilterSettings& settings) {
  Image<SvgfPixel> result(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const SvgfMoments& m = moments[p];
    result[p].colour = m.colour;
    if (guides[p].depth == 0.0) return;
    if (m.samples == 0.0) {
      result[p].deviation = -1.0;
    } else if (m.samples < double(settings.minHistory)) {
      const SpatialMoments spatial = spatialMoments(frame, guides, moments, p, settings);
      const double boost = double(settings.minHistory) / m.samples;
      result[p].deviation = std::sqrt(boost * spatial.variance);
      result[p].secondMoment = boost * spatial.secondMoment;
    } else {
      result[p].deviation = std::sqrt(m.variance());
    }
  });
  return result;
}

Image<SvgfPixel> svgfAtrous(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfPixel>& input,
                            int spacing, const SvgfFilterSettings& settings) {
  const bool full = settings.window == SvgfWindow::Full;
  int radius = static_cast<int>(settings.radius);
  if (full) radius *= (1 << settings.iterations) - 1;
  Image<SvgfPixel> result(frame.size());
  std::vector<std::pair<double, glm::dvec3>> taps;
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    result[p].colour = input[p].colour;
    result[p].deviation = input[p].deviation;
    if (guides[p].depth == 0.0) return;
    const bool luminanceWeight = settings.luminanceWeight && input[p].deviation >= 0.0;
    const double centre = luminance(input[p].colour);
    const double unit = luminanceWeight ? double(settings.sigmaLuminance) * smoothDeviation(guides, input, p) : 1.0;
    double weightSum = 0.0;
    double variance = 0.0;
    glm::dvec3 sum(0.0);
    taps.clear();
    for (int y = -radius; y <= radius; ++y) {
      for (int x = -radius; x <= radius; ++x) {
        const glm::ivec2 q = p + spacing * glm::ivec2(x, y);
        double weight = surfaceWeight(frame, guides, p, q, settings);
        weight *= full ? std::exp(-0.5 * (x * x + y * y) / kernelVariance(settings))
                       : binomial(2 * radius, radius + x) * binomial(2 * radius, radius + y);
        if (weight == 0.0 || input[q].deviation < 0.0) continue;
        if (luminanceWeight) {
          weight *= std::exp(-std::abs(luminance(input[q].colour) - centre) / (unit + centre * 1e-3 + 1e-7));
        }
        weightSum += weight;
        variance += weight * weight * input[q].deviation * input[q].deviation;
        sum += weight * input[q].colour;
        taps.emplace_back(weight, input[q].colour);
      }
    }
    if (weightSum == 0.0) return;
    result[p].colour = sum / weightSum;
    result[p].deviation = std::sqrt(variance) / weightSum;
    for (const auto& [weight, colour] : taps)
      result[p].spread += weight / weightSum * glm::abs(colour - result[p].colour);
  });
  return result;
}

}  // namespace walr::reference
