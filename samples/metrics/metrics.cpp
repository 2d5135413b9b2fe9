#include "samples/metrics/metrics.h"

#include <algorithm>
#include <cmath>

#include "samples/image/tone_map.h"
#include "samples/metrics/ssim.h"

namespace walr {
namespace {

constexpr float kLeastAlbedo = 0.01F;
constexpr std::size_t kChannels = 3;

double countOf(const PixelMask& mask) {
  return static_cast<double>(std::ranges::count_if(mask, [](auto flag) { return flag != 0; }));
}

/// Mean over the mask's pixels and channels of a function of both halves of a reference, tone-mapped.
template <typename Function>
std::optional<double> meanOverHalves(const Image& reference, const Image& half, const PixelMask& mask,
                                     const Function& function) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    for (std::size_t c = 0; mask[i] != 0 && c < kChannels; ++c) {
      const float first = half.pixel(i)[c], second = 2.0F * reference.pixel(i)[c] - first;
      sum += function(i, c, toneMap(first), toneMap(second));
    }
  }
  const double count = countOf(mask);
  return count > 0.0 ? std::optional(sum / (count * kChannels)) : std::nullopt;
}

}  // namespace

PixelMask diffuseMask(const Image& albedo, const Image& normal, const Image& depth, float skyDepth) {
  PixelMask mask(albedo.pixelCount());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const bool diffuse = std::ranges::any_of(albedo.pixel(i), [](float a) { return a >= kLeastAlbedo; });
    const bool surface = depth.pixel(i)[0] < skyDepth &&
                         std::ranges::any_of(normal.pixel(i), [](float component) { return component != 0.0F; });
    mask[i] = diffuse && surface ? 1 : 0;
  }
  return mask;
}

PixelMask diffuseMask(const Image& albedo, const Image& normal, const Image& depth, float skyDepth,
                      const Image& reference) {
  PixelMask mask = diffuseMask(albedo, normal, depth, skyDepth);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!std::ranges::all_of(reference.pixel(i), [](float value) { return std::isfinite(value); })) mask[i] = 0;
  }
  return mask;
}

ErrorFigures compare(const Image& test, const Image& reference, const PixelMask& mask) {
  return compare(display(test, reference, mask), mask);
}

std::optional<double> rmseOf(const DisplayedPair& pair, const PixelMask& mask) {
  const double count = countOf(mask);
  if (count == 0.0) return std::nullopt;
  double squares = 0.0;
  for (std::size_t c = 0; c < kChannels; ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] == 0) continue;
      const double difference = static_cast<double>(pair.test.pixel(i)[c]) - pair.reference.pixel(i)[c];
      squares += difference * difference;
    }
  }
  return std::sqrt(squares / (count * kChannels));
}

ErrorFigures compare(const DisplayedPair& pair, const PixelMask& mask) {
  ErrorFigures figures;
  figures.rmse = rmseOf(pair, mask);
  if (!figures.rmse) return figures;
  double similarities = 0.0;
  bool hasWindows = true;
  std::vector<double> testPlane(mask.size());
  std::vector<double> referencePlane(mask.size());
  for (std::size_t c = 0; c < kChannels; ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      testPlane[i] = pair.test.pixel(i)[c];
      referencePlane[i] = pair.reference.pixel(i)[c];
    }
    const auto similarity =
        structuralSimilarity(testPlane, referencePlane, mask, pair.reference.width(), pair.reference.height());
    hasWindows = similarity.has_value();
    similarities += similarity.value_or(0.0);
  }
  if (*figures.rmse > 0.0) {
    figures.psnr = -20.0 * std::log10(*figures.rmse);
  }
  if (hasWindows) {
    figures.ssim = similarities / kChannels;
  }
  return figures;
}

std::optional<double> relativeMse(const Image& test, const Image& reference, const PixelMask& mask) {
  constexpr double kEpsilon = 0.01;
  constexpr double kWorst = 65504.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    for (std::size_t c = 0; mask[i] != 0 && c < kChannels; ++c) {
      const double expected = reference.pixel(i)[c];
      const double value = std::isfinite(test.pixel(i)[c]) ? test.pixel(i)[c] : kWorst;
      sum += (value - expected) * (value - expected) / (expected * expected + kEpsilon);
    }
  }
  const double count = countOf(mask);
  return count > 0.0 ? std::optional(sum / (count * kChannels)) : std::nullopt;
}

std::optional<double> referenceNoise(const Image& reference, const Image& half, const PixelMask& mask) {
  const auto squares = meanOverHalves(reference, half, mask,
                                      [](std::size_t, std::size_t, double a, double b) { return (a - b) * (a - b); });
  return squares ? std::optional(0.5 * std::sqrt(*squares)) : std::nullopt;
}

std::optional<double> cleanSquare(const Image& test, const Image& reference, const Image& half, const PixelMask& mask) {
  return meanOverHalves(reference, half, mask, [&](std::size_t i, std::size_t c, double a, double b) {
    const double value = test.pixel(i)[c];
    return (value - a) * (value - b);
  });
}

std::size_t countNonFinite(const Image& image) {
  return static_cast<std::size_t>(
      std::ranges::count_if(image.values(), [](float value) { return !std::isfinite(value); }));
}

void MeanFigures::Sum::add(const std::optional<double>& value) {
  if (value) {
    total += *value;
    ++count;
  }
}

std::optional<double> MeanFigures::Sum::mean() const {
  return count > 0 ? std::optional(total / static_cast<double>(count)) : std::nullopt;
}

void MeanFigures::add(const ErrorFigures& figures) {
  rmse_.add(figures.rmse);
  psnr_.add(figures.psnr);
  ssim_.add(figures.ssim);
}

ErrorFigures MeanFigures::mean() const {
  return {rmse_.mean(), psnr_.mean(), ssim_.mean()};
}

}  // namespace walr
