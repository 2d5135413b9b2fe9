#include "samples/metrics/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace walr {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;
constexpr double kC2 = 0.03 * 0.03;

using Window = std::array<double, 2 * kRadius + 1>;

Window gaussianWindow() {
  Window window{};
  double sum = 0.0;
  for (int i = -kRadius; i <= kRadius; ++i) {
    const double weight = std::exp(-0.5 * i * i / (kSigma * kSigma));
    window.at(static_cast<std::size_t>(i + kRadius)) = weight;
    sum += weight;
  }
  for (double& weight : window) {
    weight /= sum;
  }
  return window;
}

/// Weighted means of x, y, xx, yy and xy over a window.
struct Moments {
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;

  void addWeighted(double weight, const Moments& other) {
    x += weight * other.x;
    y += weight * other.y;
    xx += weight * other.xx;
    yy += weight * other.yy;
    xy += weight * other.xy;
  }
};

/// Wang et al. 2004, eq. 13.
double similarity(const Moments& m) {
  const double varianceX = m.xx - m.x * m.x;
  const double varianceY = m.yy - m.y * m.y;
  const double covariance = m.xy - m.x * m.y;
  return (2.0 * m.x * m.y + kC1) * (2.0 * covariance + kC2) /
         ((m.x * m.x + m.y * m.y + kC1) * (varianceX + varianceY + kC2));
}

}  // namespace

std::vector<double> similarityMap(std::span<const double> test, std::span<const double> reference,
                                  const PixelMask& mask, int width, int height) {
  const Window window = gaussianWindow();
  const auto index = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  std::vector<double> map(mask.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<Moments> columns(static_cast<std::size_t>(width));
  for (int y = kRadius; y < height - kRadius; ++y) {
    // The window is separable: first sum down every column that a pixel of the mask needs, then along the row.
    int ahead = 0;  // Columns up to this one have been looked at.
    int last = -1;  // The last column that is needed.
    for (int x = 0; x < width; ++x) {
      for (; ahead < std::min(x + kRadius + 1, width); ++ahead) {
        if (mask[index(ahead, y)] != 0) last = ahead + kRadius;
      }
      if (x > last) continue;
      Moments column;
      for (int dy = -kRadius; dy <= kRadius; ++dy) {
        const double a = test[index(x, y + dy)];
        const double b = reference[index(x, y + dy)];
        column.addWeighted(window.at(static_cast<std::size_t>(dy + kRadius)), {a, b, a * a, b * b, a * b});
      }
      columns[static_cast<std::size_t>(x)] = column;
    }
    for (int x = kRadius; x < width - kRadius; ++x) {
      if (mask[index(x, y)] == 0) {
        continue;
      }
      Moments moments;
      for (int dx = -kRadius; dx <= kRadius; ++dx) {
        moments.addWeighted(window.at(static_cast<std::size_t>(dx + kRadius)),
                            columns[static_cast<std::size_t>(x + dx)]);
      }
      map[index(x, y)] = similarity(moments);
    }
  }
  return map;
}

std::optional<double> structuralSimilarity(std::span<const double> test, std::span<const double> reference,
                                           const PixelMask& mask, int width, int height) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : similarityMap(test, reference, mask, width, height)) {
    if (!std::isnan(value)) {
      sum += value;
      ++count;
    }
  }
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

}  // namespace walr
