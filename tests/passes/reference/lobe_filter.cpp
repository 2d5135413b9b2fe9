#include "tests/passes/reference/lobe_filter.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// Light with the standard error of its luminance; below 0: there is none.
struct Light {
  glm::dvec3 colour{0.0};
  double error = -1.0;
};

/// What tells how far two pixels reflect the same light.
class Lobes {
 public:
  Lobes(const HostFrame& frame, const Image<Guide>& guides, const Image<Reflector>& reflectors)
      : frame_(frame), guides_(guides), reflectors_(reflectors) {}

  [[nodiscard]] bool isSurface(glm::ivec2 p) const { return guides_.contains(p) && guides_[p].depth != 0.0; }

  /// @param hasLight whether `p` has
  [[nodiscard]] double weight(glm::ivec2 p, glm::ivec2 q, bool hasLight) const {
    const glm::dvec3 way =
        direction(q) + (position(q) - position(p)) * (reflectors_[p].inverseDistance / guides_[p].depth);
    const bool mirror = hasLight && isMirror(p);
    const double turn = glm::distance(glm::normalize(way), direction(p)), wider = angle(q) - angle(p);
    const double part = std::clamp(1.6 - 5.0 * angle(p), 0.7, 1.4) * std::max(angle(p), 0.02);
    const double widest = 1.0 / (0.41 * 0.41), narrowest = widest + (hasLight ? 1.0 / (part * part) : 0.0);
    const double plane = std::abs(glm::dot(normal(p), position(q) - position(p))) / guides_[p].depth;
    const double lobe = 0.5 * (turn * turn * (mirror ? widest : narrowest) + wider * wider * narrowest) + plane / 0.02;
    return std::exp(-lobe) * std::exp2(mirror ? -5.0 * std::abs(nearness(q) - nearness(p)) : 0.0);
  }

  [[nodiscard]] bool isMirror(glm::ivec2 p) const { return reflectors_[p].roughness < 0.1; }

 private:
  [[nodiscard]] glm::dvec3 ray(glm::ivec2 p) const { return rayThrough(frame_.constants.rayFromPixel, pixelCentre(p)); }
  [[nodiscard]] glm::dvec3 position(glm::ivec2 p) const { return ray(p) * guides_[p].depth; }
  [[nodiscard]] glm::dvec3 normal(glm::ivec2 p) const { return octahedralDecode(guides_[p].features); }
  [[nodiscard]] glm::dvec3 direction(glm::ivec2 p) const { return glm::reflect(glm::normalize(ray(p)), normal(p)); }
  /// In octaves.
  [[nodiscard]] double nearness(glm::ivec2 p) const {
    return std::log2(std::max(reflectors_[p].inverseDistance, 1e-3));
  }
  [[nodiscard]] double angle(glm::ivec2 p) const { return 2.0 * std::pow(reflectors_[p].roughness, 2.0); }

  const HostFrame& frame_;
  const Image<Guide>& guides_;
  const Image<Reflector>& reflectors_;
};

/// Variance of a mean of n frames, over that of a frame. That of an exponential mean is 1 / (2 n - 1).
double varianceOfMean(double n, double maxHistory) {
  const double rounded = 1.125;  // Packing makes a length so many times as long at most.
  const bool exponential = rounded * n >= maxHistory && n <= rounded * maxHistory;
  return 1.0 / std::max(exponential ? 2.0 * n - 1.0 : n, 1.0);
}

/// Visits the pixels of 3 x 3 taps.
template <typename Visit>
void forTaps(glm::ivec2 p, int spacing, const Visit& visit) {
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) visit(p + spacing * glm::ivec2(x, y), glm::ivec2(x, y));
}

}  // namespace

Image<glm::dvec3> lobeFilter(const HostFrame& frame, const Image<Guide>& guides, const Image<Reflector>& reflectors,
                             const Image<glm::dvec4>& accumulated, const Image<glm::dvec4>& lighting,
                             double maxHistory) {
  const Lobes lobes(frame, guides, reflectors);
  // Variances of a sample's luminance by this frame's sample and the mean that holds it; below 0 without both.
  Image<double> squares(guides.size(), -1.0);
  Image<Light> light(guides.size());
  const auto hasLight = [&](glm::ivec2 q) { return lobes.isSurface(q) && light[q].error >= 0.0; };
  forEachPixel(guides.size(), [&](glm::ivec2 p) {
    const double samples = accumulated[p].a;
    if (samples > 0.0) light[p] = {glm::dvec3(accumulated[p]), 0.0};
    if (samples < 1.5 || lighting[p].a == 0.0) return;
    const double difference = luminance(glm::dvec3(lighting[p]) - glm::dvec3(accumulated[p]));
    squares[p] = difference * difference * samples / (samples - 1.0);
  });
  double luminanceErrors = 15.0;
  for (const int spacing : {1, 3, 8}) {
    Image<Light> filtered(guides.size());
    forEachPixel(guides.size(), [&](glm::ivec2 p) {
      if (!lobes.isSurface(p)) return;
      double variance = 0.0, weights = 0.0, measured = 0.0, sum = 0.0, sumOfSquares = 0.0, variances = 0.0;
      forTaps(p, spacing, [&](glm::ivec2 q, glm::ivec2 tap) {
        if (!hasLight(q)) return;
        if (spacing > 1 && tap.x != 0 && tap.y != 0) return;
        weights += 1.0;
        if (spacing > 1) {
          variance += std::pow(light[q].error, 2.0);
          return;
        }
        const double l = luminance(light[q].colour);
        variance += std::max(squares[q], 0.0);
        measured += squares[q] >= 0.0 ? 1.0 : 0.0;
        sum += l;
        sumOfSquares += l * l;
        variances += varianceOfMean(accumulated[q].a, maxHistory);
      });
      if (weights == 0.0) return;
      double error = std::sqrt(variance / weights), deviation = 0.0;
      if (spacing == 1) {
        const double spread =
            std::max(sumOfSquares / weights - std::pow(sum / weights, 2.0), 0.0) * weights / variances;
        const double known = std::min(4.0 * measured / weights, 1.0);
        deviation = std::sqrt(4.0 * (1.0 - known) * spread + known * variance / std::max(measured, 1e-6));
        error = deviation * std::sqrt(varianceOfMean(accumulated[p].a, maxHistory));
      }
      const bool own = hasLight(p);
      const double ownLuminance = luminance(light[p].colour);
      const double unit = (lobes.isMirror(p) ? 3.2 : luminanceErrors) * error + 1e-3 * ownLuminance + 1e-7;
      glm::dvec3 colour(0.0);
      double mixed = 0.0, total = 0.0;
      forTaps(p, spacing, [&](glm::ivec2 q, glm::ivec2 /*tap*/) {
        if (!hasLight(q)) return;
        const double difference = own ? std::abs(luminance(light[q].colour) - ownLuminance) / unit : 0.0;
        const double weight = lobes.weight(p, q, own) * std::exp(-difference);
        const double tapVariance = spacing > 1 ? std::pow(light[q].error, 2.0)
                                               : (squares[q] >= 0.0 ? squares[q] : deviation * deviation) *
                                                     varianceOfMean(accumulated[q].a, maxHistory);
        colour += weight * light[q].colour;
        mixed += weight * weight * tapVariance;
        total += weight;
      });
      if (total > 0.0) filtered[p] = {colour / total, std::sqrt(mixed) / total};
    });
    light = filtered;
    luminanceErrors *= 0.5;
  }
  Image<glm::dvec3> result(guides.size());
  forEachPixel(guides.size(),
               [&](glm::ivec2 p) { result[p] = lobes.isSurface(p) ? light[p].colour : glm::dvec3(lighting[p]); });
  return result;
}

}  // namespace walr::reference
