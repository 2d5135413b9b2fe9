#include "samples/bench/response.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "samples/bench/response_scene.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/image/luminance.h"
#include "samples/metrics/metrics.h"
#include "samples/metrics/temporal.h"

namespace walr {
namespace {

constexpr fg::Extent kExtent{192, 108};
constexpr int kSettledFrom = 16;
constexpr double kLightGone = 0.1;
constexpr double kRecovered = 1.25;

/// Accumulates a mean.
struct Mean {
  double sum = 0.0;
  double count = 0.0;
  void add(double value) {
    sum += value;
    count += 1.0;
  }
  [[nodiscard]] double value() const { return count > 0.0 ? sum / count : 0.0; }
};

double meanLuminance(const Image& image) {
  Mean mean;
  for (std::size_t i = 0; i < image.pixelCount(); ++i) mean.add(luminance(image.pixel(i)));
  return mean.value();
}

template <typename Values, typename Predicate>
std::optional<int> firstIndex(const Values& values, Predicate predicate) {
  const auto found = std::ranges::find_if(values, predicate);
  return found == values.end() ? std::nullopt : std::optional(static_cast<int>(found - values.begin()));
}

void answerToLight(const GpuDevice& device, const Variant& variant, Response& response) {
  GpuDenoiser denoiser(device, *makeVariant(variant), kExtent, projectLayout());
  const PixelMask all(static_cast<std::size_t>(kExtent.width) * kExtent.height, 1);
  std::vector<std::uint32_t> itself(all.size());
  for (std::size_t i = 0; i < itself.size(); ++i) itself[i] = static_cast<std::uint32_t>(i);
  const double before = meanLuminance(lightFrame(kExtent, 0).truth);
  Mean settled;
  Mean flickers;
  DisplayedPair previous;
  for (int i = 0; i < kLightFrames; ++i) {
    const KnownFrame frame = lightFrame(kExtent, i);
    const Image result = denoiser.run(frame.packed).lights.front();
    DisplayedPair pair = display(result, frame.truth, all);
    const double rmse = compare(pair, all).rmse.value();
    if (i == 0) response.firstFrame = rmse;
    if (i >= kSettledFrom && i < kLightChange) {
      settled.add(rmse);
      flickers.add(flicker(errorChange(pair, previous, itself)).value());
    }
    if (i >= kLightChange) {
      const double after = meanLuminance(frame.truth);
      response.lightLeft.push_back((meanLuminance(result) - after) / (before - after));
    }
    previous = std::move(pair);
  }
  response.settled = settled.value();
  response.settledFlicker = flickers.value();
  response.lightFrames = firstIndex(response.lightLeft, [](double left) { return left <= kLightGone; });
}

void answerToDisocclusion(const GpuDevice& device, const Variant& variant, Response& response) {
  constexpr int kFirstMeasured = 8;
  GpuDenoiser denoiser(device, *makeVariant(variant), kExtent, projectLayout());
  std::array<Mean, kResponseAges> squares;
  std::array<Mean, kResponseAges> bias;
  Mean undisturbed;
  Mean slabOverWall;
  for (int i = 0; i < kSlabFrames; ++i) {
    const KnownFrame frame = slabFrame(kExtent, i);
    const Image result = denoiser.run(frame.packed).lights.front();
    if (i < kFirstMeasured) continue;
    const DisplayedPair pair = display(result, frame.truth, PixelMask(frame.age.size(), 1));
    Mean slab;
    Mean wall;
    for (std::size_t pixel = 0; pixel < frame.age.size(); ++pixel) {
      const int age = frame.age[pixel];
      const double truth = luminance(pair.reference.pixel(pixel));
      const double error = luminance(pair.test.pixel(pixel)) - truth;
      const double light = luminance(frame.truth.pixel(pixel));
      (age < 0 ? slab : wall).add(light);
      // Noise is proportional to the light, so only relative errors are comparable between places.
      const double relative = error / truth;
      if (age == kAlwaysInView) undisturbed.add(relative * relative);
      if (age < 0 || age >= kResponseAges) continue;
      squares.at(static_cast<std::size_t>(age)).add(relative * relative);
      // In linear radiance, because the mean of tone-mapped noise is not the tone-mapped mean.
      bias.at(static_cast<std::size_t>(age)).add(luminance(result.pixel(pixel)) - light);
    }
    slabOverWall.add(slab.value() - wall.value());
  }
  for (std::size_t age = 0; age < kResponseAges; ++age) {
    response.errorByAge.push_back(std::sqrt(squares.at(age).value()));
    response.trailByAge.push_back(bias.at(age).value() / slabOverWall.value());
  }
  const double settled = std::sqrt(undisturbed.value());
  response.recoveryFrames =
      firstIndex(response.errorByAge, [&](double error) { return error <= kRecovered * settled; });
}

std::vector<double> luminances(const Image& image) {
  std::vector<double> values;
  for (std::size_t i = 0; i < image.pixelCount(); ++i) values.push_back(luminance(image.pixel(i)));
  return values;
}

double squaredDistance(const std::vector<double>& a, const std::vector<double>& b) {
  return std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                               [](double x, double y) { return (x - y) * (x - y); });
}

/// Offset of a parabola's minimum from the middle one of three neighbouring values.
double vertex(double before, double middle, double after) {
  const double curvature = before - 2.0 * middle + after;
  return curvature > 0.0 ? 0.5 * (before - after) / curvature : 0.0;
}

void answerToMovingLight(const GpuDevice& device, const Variant& variant, Response& response) {
  constexpr int kFirstMeasured = 24;
  constexpr int kOldest = 40;
  constexpr int kNewest = -2;  // Negative: a result can be nearest to a future truth only because of noise.
  std::map<int, std::vector<double>> truths;
  for (int frame = kFirstMeasured - kOldest; frame < kMovingLightFrames - kNewest; ++frame) {
    truths[frame] = luminances(movingLightFrame(kExtent, frame).truth);
  }
  GpuDenoiser denoiser(device, *makeVariant(variant), kExtent, projectLayout());
  std::vector<double> distanceByAge(kOldest - kNewest + 1);
  for (int frame = 0; frame < kMovingLightFrames; ++frame) {
    const std::vector<double> result = luminances(denoiser.run(movingLightFrame(kExtent, frame).packed).lights.front());
    for (int age = kNewest; frame >= kFirstMeasured && age <= kOldest; ++age) {
      distanceByAge.at(static_cast<std::size_t>(age - kNewest)) += squaredDistance(result, truths.at(frame - age));
    }
  }
  const auto nearest =
      std::clamp(std::ranges::min_element(distanceByAge), distanceByAge.begin() + 1, distanceByAge.end() - 2);
  response.lightLag =
      static_cast<double>(nearest - distanceByAge.begin()) + kNewest + vertex(*(nearest - 1), *nearest, *(nearest + 1));
}

CutResponse answerToCut(const GpuDevice& device, const Variant& variant, bool told) {
  GpuDenoiser denoiser(device, *makeVariant(variant), kExtent, projectLayout());
  for (int frame = 0; frame < kCut; ++frame) denoiser.run(cutFrame(kExtent, frame, told).packed);
  const KnownFrame frame = cutFrame(kExtent, kCut, told);
  const Image result = denoiser.run(frame.packed).lights.front();
  const std::vector<double> shown = luminances(result);
  const std::vector<double> now = luminances(frame.truth);
  const std::vector<double> old = luminances(cutFrame(kExtent, kCut - 1, told).truth);
  double common = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) common += (shown[i] - now[i]) * (old[i] - now[i]);
  const PixelMask all(now.size(), 1);
  return {compare(result, frame.truth, all).rmse.value(), common / squaredDistance(old, now)};
}

}  // namespace

std::vector<Response> responses(const GpuDevice& device, std::span<const Variant> variants) {
  std::vector<Response> all;
  for (const Variant& variant : variants) {
    Response& response = all.emplace_back();
    response.variant = variant.name;
    answerToLight(device, variant, response);
    answerToDisocclusion(device, variant, response);
    answerToMovingLight(device, variant, response);
    response.cut = answerToCut(device, variant, true);
    response.untoldCut = answerToCut(device, variant, false);
  }
  return all;
}

}  // namespace walr
