#include "samples/metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "samples/image/luminance.h"

namespace walr {
namespace {

constexpr double kDepthTolerance = 0.03;
constexpr double kLeastCosine = 0.8660254037844386;  // The cosine of 30 degrees.

double dot(std::span<const float> a, std::span<const float> b) {
  return static_cast<double>(a[0]) * b[0] + static_cast<double>(a[1]) * b[1] + static_cast<double>(a[2]) * b[2];
}

}  // namespace

std::vector<std::uint32_t> previousPixels(const VisibleSurfaces& current, const VisibleSurfaces& previous) {
  const int width = current.depth.width();
  const int height = current.depth.height();
  std::vector<std::uint32_t> found(current.mask.size(), kNoPixel);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (current.mask[pixel] == 0) continue;
      const auto motion = current.motion.pixel(pixel);
      const double previousX = std::floor(x + 0.5 + motion[0]);
      const double previousY = std::floor(y + 0.5 + motion[1]);
      // Negated so that the test also rejects motion that is NaN.
      if (!(previousX >= 0 && previousX < width && previousY >= 0 && previousY < height)) continue;
      const auto candidate =
          static_cast<std::size_t>(previousY) * static_cast<std::size_t>(width) + static_cast<std::size_t>(previousX);
      if (previous.mask[candidate] == 0) continue;
      const double depth = current.depth.pixel(pixel)[0] + static_cast<double>(motion[2]);
      const bool sameDepth = std::abs(previous.depth.pixel(candidate)[0] - depth) <= kDepthTolerance * std::abs(depth);
      if (sameDepth && dot(current.normal.pixel(pixel), previous.normal.pixel(candidate)) >= kLeastCosine) {
        found[pixel] = static_cast<std::uint32_t>(candidate);
      }
    }
  }
  return found;
}

std::optional<double> disoccludedShare(const std::vector<std::uint32_t>& previousPixels, const PixelMask& mask) {
  const auto all = static_cast<double>(std::ranges::count_if(mask, [](auto flag) { return flag != 0; }));
  const auto kept =
      static_cast<double>(std::ranges::count_if(previousPixels, [](std::uint32_t pixel) { return pixel != kNoPixel; }));
  return all > 0.0 ? std::optional(1.0 - kept / all) : std::nullopt;
}

std::optional<LuminanceChange> luminanceChange(const DisplayedPair& current, const DisplayedPair& previous,
                                               const PixelMask& currentMask, const PixelMask& previousMask) {
  LuminanceChange change;
  std::size_t count = 0;
  for (std::size_t i = 0; i < currentMask.size(); ++i) {
    if (currentMask[i] == 0 || previousMask[i] == 0) continue;
    change.test += std::abs(luminance(current.test.pixel(i)) - luminance(previous.test.pixel(i)));
    change.reference += std::abs(luminance(current.reference.pixel(i)) - luminance(previous.reference.pixel(i)));
    ++count;
  }
  if (count == 0) return std::nullopt;
  change.test /= static_cast<double>(count);
  change.reference /= static_cast<double>(count);
  return change;
}

std::vector<double> errorChange(const DisplayedPair& current, const DisplayedPair& previous,
                                const std::vector<std::uint32_t>& previousPixels) {
  const auto error = [](const DisplayedPair& pair, std::size_t i) {
    return luminance(pair.test.pixel(i)) - luminance(pair.reference.pixel(i));
  };
  std::vector<double> change(previousPixels.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (previousPixels[i] == kNoPixel) continue;
    change[i] = (error(current, i) - error(previous, previousPixels[i])) / std::numbers::sqrt2;
  }
  return change;
}

std::optional<double> flicker(std::span<const double> errorChange) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const double change : errorChange) {
    if (std::isnan(change)) continue;
    squares += change * change;
    ++count;
  }
  return count > 0 ? std::optional(std::sqrt(squares / static_cast<double>(count))) : std::nullopt;
}

}  // namespace walr
