#include "samples/metrics/metrics.h"

#include <algorithm>
#include <cmath>

#include "samples/image/tone_map.h"
#include "samples/metrics/ssim.h"

namespace walr {
namespace {

constexpr float kLeastAlbedo = 0.01F;
constexpr std::size_t kChannels = 3;

double toneMapped(float test, double reference) {
  if (!std::isfinite(test)) {
    return reference > 0.5 ? 0.0 : 1.0;
  }
  return toneMap(test);
}

}  // namespace

PixelMask diffuseMask(const Image& albedo, const Image& normal, const Image& depth, float skyDepth,
                      const Image& reference) {
  PixelMask mask(albedo.pixelCount());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const bool diffuse = std::ranges::any_of(albedo.pixel(i), [](float a) { return a >= kLeastAlbedo; });
    const bool surface = depth.pixel(i)[0] < skyDepth &&
                         std::ranges::any_of(normal.pixel(i), [](float component) { return component != 0.0F; });
    const bool known = std::ranges::all_of(reference.pixel(i), [](float value) { return std::isfinite(value); });
    mask[i] = diffuse && surface && known ? 1 : 0;
  }
  return mask;
}

ErrorFigures compare(const Image& test, const Image& reference, const PixelMask& mask) {
  const auto count = static_cast<double>(std::ranges::count_if(mask, [](auto flag) { return flag != 0; }));
  if (count == 0.0) {
    return {};
  }
  double squares = 0.0;
  double similarities = 0.0;
  bool hasWindows = true;
  std::vector<double> testPlane(mask.size());
  std::vector<double> referencePlane(mask.size());
  for (std::size_t c = 0; c < kChannels; ++c) {
    for (std::size_t i = 0; i < mask.size(); ++i) {
      const float value = reference.pixel(i)[c];
      referencePlane[i] = std::isfinite(value) ? toneMap(value) : 0.0;
      testPlane[i] = mask[i] != 0 ? toneMapped(test.pixel(i)[c], referencePlane[i]) : referencePlane[i];
      const double difference = testPlane[i] - referencePlane[i];
      squares += difference * difference;
    }
    const auto similarity =
        structuralSimilarity(testPlane, referencePlane, mask, reference.width(), reference.height());
    hasWindows = similarity.has_value();
    similarities += similarity.value_or(0.0);
  }
  ErrorFigures figures;
  figures.rmse = std::sqrt(squares / (count * kChannels));
  if (*figures.rmse > 0.0) {
    figures.psnr = -20.0 * std::log10(*figures.rmse);
  }
  if (hasWindows) {
    figures.ssim = similarities / kChannels;
  }
  return figures;
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
