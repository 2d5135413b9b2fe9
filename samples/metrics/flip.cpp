#include "samples/metrics/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace walr {
namespace {

using Colour = std::array<double, 3>;
using Matrix = std::array<Colour, 3>;
using Plane = std::vector<double>;

// Linear RGB with Rec. 709 primaries to CIE XYZ.
constexpr Matrix kToXyz = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                            {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                            {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

constexpr Matrix inverse(const Matrix& m) {
  const auto cofactor = [&m](std::size_t row, std::size_t column) {
    const std::size_t r1 = (row + 1) % 3;
    const std::size_t r2 = (row + 2) % 3;
    const std::size_t c1 = (column + 1) % 3;
    const std::size_t c2 = (column + 2) % 3;
    return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
  };
  const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Matrix result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) result[row][column] = cofactor(column, row) / determinant;
  }
  return result;
}

constexpr Matrix kFromXyz = inverse(kToXyz);

constexpr Colour multiply(const Matrix& matrix, const Colour& colour) {
  Colour result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) result[row] += matrix[row][column] * colour[column];
  }
  return result;
}

constexpr Colour kWhite = multiply(kToXyz, {1.0, 1.0, 1.0});

Colour toRelativeXyz(const Colour& rgb) {
  Colour xyz = multiply(kToXyz, rgb);
  for (std::size_t i = 0; i < 3; ++i) xyz[i] /= kWhite[i];
  return xyz;
}

/// The linear opponent space in which the eye's contrast sensitivity is applied (section 4.1.1).
Colour toYCxCz(const Colour& rgb) {
  const Colour xyz = toRelativeXyz(rgb);
  return {116.0 * xyz[1] - 16.0, 500.0 * (xyz[0] - xyz[1]), 200.0 * (xyz[1] - xyz[2])};
}

Colour fromYCxCz(const Colour& opponent) {
  const double y = (opponent[0] + 16.0) / 116.0;
  const Colour relative = {y + opponent[1] / 500.0, y, y - opponent[2] / 200.0};
  return multiply(kFromXyz, {relative[0] * kWhite[0], relative[1] * kWhite[1], relative[2] * kWhite[2]});
}

/// L*a*b* with the Hunt effect: chroma fades with lightness (section 4.1.2).
Colour toHuntLab(const Colour& rgb) {
  constexpr double kDelta = 6.0 / 29.0;
  Colour f = toRelativeXyz(rgb);
  for (double& value : f) {
    value = value > kDelta * kDelta * kDelta ? std::cbrt(value) : value / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
  }
  const double lightness = 116.0 * f[1] - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]), 0.01 * lightness * 200.0 * (f[1] - f[2])};
}

/// Distance for large colour differences: city block in lightness, Euclidean in chroma (section 4.1.3).
double hyab(const Colour& a, const Colour& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

constexpr double kColourExponent = 0.7;
constexpr double kFeatureExponent = 0.5;

/// Maps colour errors to 0..1 and compresses large ones (section 4.1.3): errors below 0.4 of the largest error map to
/// 0..0.95.
double redistribute(double error) {
  static const double kLargest =
      std::pow(hyab(toHuntLab({0.0, 1.0, 0.0}), toHuntLab({0.0, 0.0, 1.0})), kColourExponent);
  constexpr double kKnee = 0.4;
  constexpr double kShare = 0.95;
  const double knee = kKnee * kLargest;
  const double value = std::pow(error, kColourExponent);
  return value < knee ? kShare / knee * value : kShare + (value - knee) / (kLargest - knee) * (1.0 - kShare);
}

/// The weights of a filter along one axis; their number is odd.
using Kernel = std::vector<double>;

Kernel gaussian(int radius, double exponentPerSquaredPixel) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(std::exp(-exponentPerSquaredPixel * i * i));
  return kernel;
}

double sum(const Kernel& kernel) {
  double total = 0.0;
  for (const double weight : kernel) total += weight;
  return total;
}

Kernel scaled(Kernel kernel, double factor) {
  for (double& weight : kernel) weight *= factor;
  return kernel;
}

/// Scales the positive weights to a sum of 1 and the negative ones to a sum of -1.
Kernel balanced(Kernel kernel) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double weight : kernel) (weight > 0.0 ? positive : negative) += weight;
  for (double& weight : kernel) weight /= weight > 0.0 ? positive : -negative;
  return kernel;
}

/// Pixels of a row, from `begin` to the one before `end`.
struct Run {
  int begin;
  int end;
};
/// The runs of every row.
using Runs = std::vector<std::vector<Run>>;

/// The size of a plane, its pixels that are wanted, and filters for these pixels.
class Field {
 public:
  /// @param wanted must outlive the field
  Field(int width, int height, const PixelMask& wanted)
      : width_(width), height_(height), mask_(wanted), wanted_(runsWithin(0)) {}

  /// Filter with one kernel along x and another along y. Beyond the border the nearest value is repeated. The result is
  /// 0 where it is not wanted.
  /// @param near `runsWithin` the radius of `alongY`
  [[nodiscard]] Plane filter(const Plane& plane, const Kernel& alongX, const Kernel& alongY, const Runs& near) const {
    const int radiusX = static_cast<int>(alongX.size()) / 2;
    const int radiusY = static_cast<int>(alongY.size()) / 2;
    Plane rows(plane.size());
    forEachPixel(near, [&](int x, int y) {
      double value = 0.0;
      for (int d = -radiusX; d <= radiusX; ++d) {
        value += alongX[static_cast<std::size_t>(d + radiusX)] * plane[index(std::clamp(x + d, 0, width_ - 1), y)];
      }
      rows[index(x, y)] = value;
    });
    Plane result(plane.size());
    for (int y = 0; y < height_; ++y) {
      for (int d = -radiusY; d <= radiusY; ++d) {
        const double weight = alongY[static_cast<std::size_t>(d + radiusY)];
        const std::size_t row = index(0, std::clamp(y + d, 0, height_ - 1));
        for (const Run& run : wanted_[static_cast<std::size_t>(y)]) {
          for (int x = run.begin; x < run.end; ++x) {
            result[index(x, y)] += weight * rows[row + static_cast<std::size_t>(x)];
          }
        }
      }
    }
    return result;
  }

  /// Call `visit` with the index of every wanted pixel.
  template <typename Visitor>
  void forEachWanted(Visitor visit) const {
    forEachPixel(wanted_, [&](int x, int y) { visit(index(x, y)); });
  }

  /// The pixels with a wanted one in the same column, at most `reach` rows away.
  [[nodiscard]] Runs runsWithin(int reach) const {
    Runs runs(static_cast<std::size_t>(height_));
    std::vector<int> last(static_cast<std::size_t>(width_), -1);  // The last row down to which a column is wanted.
    for (int y = -reach; y < height_; ++y) {
      const int ahead = y + reach;
      for (int x = 0; x < width_ && ahead < height_; ++x) {
        if (mask_[index(x, ahead)] != 0) last[static_cast<std::size_t>(x)] = ahead + reach;
      }
      if (y < 0) continue;
      bool inside = false;
      for (int x = 0; x < width_; ++x) {
        const bool near = last[static_cast<std::size_t>(x)] >= y;
        std::vector<Run>& row = runs[static_cast<std::size_t>(y)];
        if (near && !inside) row.push_back({x, x});
        if (near) row.back().end = x + 1;
        inside = near;
      }
    }
    return runs;
  }

 private:
  template <typename Visitor>
  void forEachPixel(const Runs& runs, Visitor visit) const {
    for (int y = 0; y < height_; ++y) {
      for (const Run& run : runs[static_cast<std::size_t>(y)]) {
        for (int x = run.begin; x < run.end; ++x) visit(x, y);
      }
    }
  }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  const PixelMask& mask_;
  Runs wanted_;
};

/// A contrast sensitivity function as a spatial filter (eq. 1, table 1): a sqrt(pi / b) exp(-pi^2 r^2 / b), r in
/// degrees.
struct Sensitivity {
  double a;
  double b;
};

constexpr Sensitivity kAchromatic{1.0, 0.0047};
constexpr Sensitivity kRedGreen{1.0, 0.0053};
constexpr std::array kBlueYellow{Sensitivity{34.1, 0.04}, Sensitivity{13.5, 0.025}};

/// The planes Y, Cx and Cz of an image.
using Opponent = std::array<Plane, 3>;

Opponent opponentPlanes(const Image& image) {
  Opponent planes;
  for (Plane& plane : planes) plane.resize(image.pixelCount());
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    const auto pixel = image.pixel(i);
    const Colour colour = toYCxCz({pixel[0], pixel[1], pixel[2]});
    for (std::size_t c = 0; c < 3; ++c) planes[c][i] = colour[c];
  }
  return planes;
}

/// The image filtered by the eye's contrast sensitivity (section 4.1.1), in the space of `toHuntLab`.
std::vector<Colour> perceived(const Opponent& planes, const Field& field, double pixelsPerDegree) {
  constexpr double kSquaredPi = std::numbers::pi * std::numbers::pi;
  const int radius =
      static_cast<int>(std::ceil(3.0 * std::sqrt(kBlueYellow[0].b / (2.0 * kSquaredPi)) * pixelsPerDegree));
  const auto kernel = [&](const Sensitivity& sensitivity) {
    return gaussian(radius, kSquaredPi / sensitivity.b / (pixelsPerDegree * pixelsPerDegree));
  };
  const Runs near = field.runsWithin(radius);
  const auto single = [&](const Plane& plane, const Sensitivity& sensitivity) {
    const Kernel unit = scaled(kernel(sensitivity), 1.0 / sum(kernel(sensitivity)));
    return field.filter(plane, unit, unit, near);
  };
  Opponent filtered = {single(planes[0], kAchromatic), single(planes[1], kRedGreen), Plane(planes[2].size())};
  double total = 0.0;
  for (const Sensitivity& part : kBlueYellow) {
    const double weight = part.a * std::sqrt(std::numbers::pi / part.b);
    total += weight * sum(kernel(part)) * sum(kernel(part));
  }
  for (const Sensitivity& part : kBlueYellow) {
    const Kernel weighted = scaled(kernel(part), part.a * std::sqrt(std::numbers::pi / part.b) / total);
    const Plane plane = field.filter(planes[2], weighted, kernel(part), near);
    field.forEachWanted([&](std::size_t i) { filtered[2][i] += plane[i]; });
  }
  std::vector<Colour> colours(planes[0].size());
  field.forEachWanted([&](std::size_t i) {
    Colour rgb = fromYCxCz({filtered[0][i], filtered[1][i], filtered[2][i]});
    for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
    colours[i] = toHuntLab(rgb);
  });
  return colours;
}

/// Strength of edges and of points at every pixel (section 4.2).
struct Features {
  Plane edges;
  Plane points;
};

Features features(const Plane& achromatic, const Field& field, double pixelsPerDegree) {
  constexpr double kWidthInDegrees = 0.082;
  const double deviation = 0.5 * kWidthInDegrees * pixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const Kernel smooth = gaussian(radius, 0.5 / (deviation * deviation));
  const Kernel unit = scaled(smooth, 1.0 / sum(smooth));
  Kernel slope = smooth;
  Kernel curvature = smooth;
  for (int i = -radius; i <= radius; ++i) {
    const auto at = static_cast<std::size_t>(i + radius);
    slope[at] *= -i;
    curvature[at] *= i * i / (deviation * deviation) - 1.0;
  }
  Plane normalised = achromatic;
  for (double& value : normalised) value = (value + 16.0) / 116.0;
  const Runs near = field.runsWithin(radius);
  const auto strength = [&](const Kernel& derivative) {
    const Kernel kernel = balanced(derivative);
    Plane alongX = field.filter(normalised, kernel, unit, near);
    const Plane alongY = field.filter(normalised, unit, kernel, near);
    field.forEachWanted([&](std::size_t i) { alongX[i] = std::hypot(alongX[i], alongY[i]); });
    return alongX;
  };
  return {strength(slope), strength(curvature)};
}

}  // namespace

std::vector<double> flipMap(const DisplayedPair& pair, const PixelMask& wanted, double pixelsPerDegree) {
  const Field field(pair.reference.width(), pair.reference.height(), wanted);
  const Opponent test = opponentPlanes(pair.test);
  const Opponent reference = opponentPlanes(pair.reference);
  const std::vector<Colour> testColours = perceived(test, field, pixelsPerDegree);
  const std::vector<Colour> referenceColours = perceived(reference, field, pixelsPerDegree);
  const Features testFeatures = features(test[0], field, pixelsPerDegree);
  const Features referenceFeatures = features(reference[0], field, pixelsPerDegree);
  std::vector<double> map(testColours.size());
  field.forEachWanted([&](std::size_t i) {
    const double colour = redistribute(hyab(testColours[i], referenceColours[i]));
    const double difference = std::max(std::abs(referenceFeatures.edges[i] - testFeatures.edges[i]),
                                       std::abs(referenceFeatures.points[i] - testFeatures.points[i]));
    const double feature = std::pow(difference / std::numbers::sqrt2, kFeatureExponent);
    map[i] = std::pow(colour, 1.0 - feature);
  });
  return map;
}

std::optional<double> maskedMean(std::span<const double> map, const PixelMask& mask) {
  double total = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    total += mask[i] != 0 ? map[i] : 0.0;
    count += mask[i] != 0 ? 1 : 0;
  }
  return count > 0 ? std::optional(total / static_cast<double>(count)) : std::nullopt;
}

}  // namespace walr
