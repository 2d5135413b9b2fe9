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

/// Two pixels reflect the same light as far as their lobes cover the same points.
/// @param sampled  whether p has a sample; if not, its lobe does not count
double lobeWeight(const HostFrame& frame, const Image<Guide>& guides, const Image<Lobe>& lobes, glm::ivec2 p,
                  glm::ivec2 q, const SvgfFilterSettings& settings, bool sampled) {
  const auto position = [&](glm::ivec2 pixel) {
    return rayThrough(frame.constants.rayFromPixel, pixelCentre(pixel)) * guides[pixel].depth;
  };
  const Lobe& own = lobes[p];
  const Lobe& other = lobes[q];
  // The point that the other lobe's middle meets, over its distance.
  const glm::dvec3 way = other.direction + (position(q) - position(p)) * (own.nearness / guides[p].depth);
  const double turn = glm::distance(glm::normalize(way), own.direction);
  const double unit = std::max(double(settings.lobeShare) * own.angle, 1e-4);
  // Mirrored directions turn twice as far as normals, and cos^s a is nearly exp(-s a^2 / 2).
  const double inverseSquare = (sampled ? 1.0 / (unit * unit) : 0.0) + double(settings.sigmaNormal) / 4.0;
  return std::exp(-0.5 * (turn * turn + std::pow(other.angle - own.angle, 2.0)) * inverseSquare);
}

/// Edge-stopping functions of depth and normal (Schied et al. 2017, 4.4) between two pixels, the depth one by distance
/// from the plane of p; 0 where q has no surface.
/// @param lobes  of specular light, whose weight takes the place of that of normals; else empty
/// @param sampled  whether p has a sample
double surfaceWeight(const HostFrame& frame, const Image<Guide>& guides, glm::ivec2 p, glm::ivec2 q,
                     const SvgfFilterSettings& settings, const Image<Lobe>& lobes = {}, bool sampled = true) {
  if (!guides.contains(q) || guides[q].depth == 0.0) return 0.0;
  const auto position = [&](glm::ivec2 pixel) {
    return rayThrough(frame.constants.rayFromPixel, pixelCentre(pixel)) * guides[pixel].depth;
  };
  const double distance = std::abs(glm::dot(guides[p].normal, position(q) - position(p))) / guides[p].depth;
  const double byPlane = std::exp(-distance / double(settings.sigmaDepth));
  if (!lobes.pixels().empty()) return byPlane * lobeWeight(frame, guides, lobes, p, q, settings, sampled);
  const double cosine = glm::dot(octahedralDecode(guides[p].features), octahedralDecode(guides[q].features));
  return byPlane * std::pow(std::clamp(cosine, 1e-6, 1.0), double(settings.sigmaNormal));
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

/// History taps that another stage has found.
std::array<HistoryTap, 4> givenTaps(glm::dvec2 pixel, std::uint32_t accepted) {
  const glm::dvec2 base = glm::floor(pixel - 0.5);
  const glm::dvec2 fraction = pixel - 0.5 - base;
  std::array<HistoryTap, 4> taps;
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 offset(i % 2, i / 2);
    const glm::dvec2 weights = glm::mix(1.0 - fraction, fraction, glm::dvec2(offset));
    taps.at(i) = {
        .pixel = glm::ivec2(base) + offset, .weight = weights.x * weights.y, .matches = ((accepted >> i) & 1U) != 0U};
  }
  return taps;
}

}  // namespace

Image<Lobe> svgfLobes(const HostFrame& frame, const Image<Guide>& guides, const Image<SvgfMoments>& moments) {
  Image<Lobe> lobes(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    const glm::dvec3 seen = glm::normalize(rayThrough(frame.constants.rayFromPixel, pixelCentre(p)));
    const double r = frame.roughness[p];
    lobes[p] = {glm::reflect(seen, octahedralDecode(guides[p].features)), roundToHalf(2.0 * std::atan(r * r)),
                roundToHalf(moments[p].nearness)};
  });
  return lobes;
}

double SvgfMoments::variance() const {
  return std::max(square - mean * mean, 0.0);
}

Image<SvgfMoments> svgfAccumulate(const HostFrame& frame, const Image<Guide>& guides, const SvgfHistory& history,
                                  const SvgfAccumulationSettings& settings,
                                  const std::optional<SvgfReflection>& reflection) {
  Image<SvgfMoments> result(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    SvgfMoments& out = result[p];
    const glm::dvec3 noisy = frame.lighting[p];
    if (guides[p].depth == 0.0) {
      const bool sampled = !reflection || frame.lightAlpha[p] > 0.0;
      out.colour = sampled && isFinite(noisy) ? noisy : glm::dvec3(0.0);
      return;
    }
    if (!history.guides.pixels().empty()) {
      Reprojection r;
      std::array<HistoryTap, 4> taps;
      if (reflection) {
        r = {.pixel = pixelCentre(p) + reflection->motion, .valid = true};
        taps = givenTaps(r.pixel, reflection->accepted[p]);
      } else {
        r = reproject(frame, guides, p);
        taps = historyTaps(frame, r, history.guides,
                           {HistoryRejection::Plane, double(settings.thresholds.planeTolerance),
                            double(settings.thresholds.normalThreshold)});
      }
      for (HistoryTap& tap : taps) tap.matches = tap.matches && history.moments[tap.pixel].w > 0.0;
      const HistorySample colour = sampleHistory(r, taps, history.colour, {});
      const HistorySample moments = sampleHistory(r, taps, history.moments, {});
      out.colour = glm::dvec3(colour.value);
      out.mean = moments.value.x;
      out.square = moments.value.y;
      out.nearness = moments.value.z;
      out.samples = moments.value.w;
      out.colourError = colour.error;
      out.momentError = moments.error;
      out.undecided = moments.undecided;
    }
    if (reflection) out.samples = std::min(out.samples, double(settings.maxHistory) * reflection->confidence[p]);
    if (!isFinite(noisy) || (reflection && !(frame.lightAlpha[p] > 0.0))) return;
    const glm::dvec3 radiance = glm::clamp(noisy, 0.0, kLargestHalf);
    const double l = luminance(radiance);
    out.samples = std::min(out.samples + 1.0, double(settings.maxHistory));
    const double momentAlpha = 1.0 / std::min(out.samples, double(settings.maxMomentHistory));
    out.colour += (radiance - out.colour) / out.samples;
    out.mean += (l - out.mean) * momentAlpha;
    out.square += (l * l - out.square) * momentAlpha;
    if (!reflection) return;
    constexpr double kFar = 65504.0;
    const double nearness = frame.lightAlpha[p] < kFar ? std::min(guides[p].depth / frame.lightAlpha[p], 1000.0) : 0.0;
    out.nearness += (nearness - out.nearness) / out.samples;
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
                            int spacing, const SvgfFilterSettings& settings, const Image<Lobe>& lobes) {
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
        double weight = surfaceWeight(frame, guides, p, q, settings, lobes, input[p].deviation >= 0.0);
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
