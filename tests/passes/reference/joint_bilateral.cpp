#include "tests/passes/reference/joint_bilateral.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/passes/reference/moments.h"
#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// The guides of a pixel, decoded.
struct Decoded {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};
  glm::dvec3 radiance{0.0};
  bool valid = false;
};

double squared(double x) {
  return x * x;
}

Image<Decoded> decode(const HostFrame& frame, const Image<Guide>& guides) {
  Image<Decoded> result(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (guides[p].depth == 0.0) return;
    const glm::dvec3 c = frame.lighting[p];
    Decoded& out = result[p];
    out.position = rayThrough(frame.constants.rayFromPixel, pixelCentre(p)) * guides[p].depth;
    out.normal = octahedralDecode(guides[p].features);
    out.valid = std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
    if (out.valid) out.radiance = glm::clamp(c, 0.0, kLargestHalf);
  });
  return result;
}

/// Mean luminance over 9x9 pixels spread over the window: the unit of colour distances.
double windowLuminance(const Image<Decoded>& decoded, glm::ivec2 p, int radius) {
  double sum = 0.0;
  int count = 0;
  for (int y = -4; y <= 4; ++y) {
    for (int x = -4; x <= 4; ++x) {
      const glm::ivec2 q = p + glm::ivec2(x, y) * radius / 4;
      if (!decoded.contains(q) || !decoded[q].valid) continue;
      sum += luminance(decoded[q].radiance);
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

Image<BilateralPixel> jointBilateral(const HostFrame& frame, const Image<Guide>& guides,
                                     const JointBilateralFilterSettings& settings) {
  const Image<Decoded> decoded = decode(frame, guides);
  const int radius = static_cast<int>(settings.radius);
  Image<BilateralPixel> result(frame.size());
  std::vector<std::pair<double, glm::dvec3>> taps;
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const Decoded& centre = decoded[p];
    if (guides[p].depth == 0.0) {
      const glm::dvec3 c = frame.lighting[p];
      if (std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)) result[p].colour = c;
      return;
    }
    const double unit = std::isfinite(settings.sigmaColour) && centre.valid
                            ? std::max(windowLuminance(decoded, p, radius), 1e-6) * double(settings.sigmaColour)
                            : double(JointBilateralFilterSettings::kInfinity);
    glm::dvec3 sum(0.0);
    double weightSum = 0.0;
    taps.clear();
    for (int y = std::max(p.y - radius, 0); y <= std::min(p.y + radius, frame.size().y - 1); ++y) {
      for (int x = std::max(p.x - radius, 0); x <= std::min(p.x + radius, frame.size().x - 1); ++x) {
        const glm::ivec2 q(x, y);
        const Decoded& other = decoded[q];
        if (!other.valid) continue;
        const glm::dvec3 way = other.position - centre.position;
        const double sine = q == p ? 0.0 : glm::dot(guides[p].normal, way) / glm::length(way);
        const double angle = std::acos(std::clamp(glm::dot(centre.normal, other.normal), -1.0, 1.0));
        const double exponent = squared(glm::length(glm::dvec2(q - p)) / double(settings.sigmaPosition)) +
                                squared(glm::length(other.radiance - centre.radiance) / unit) +
                                squared(angle / double(settings.sigmaNormal)) +
                                squared(sine / double(settings.sigmaPlane));
        const double weight = std::exp(-exponent / 2.0);
        sum += weight * other.radiance;
        weightSum += weight;
        taps.emplace_back(weight, other.radiance);
      }
    }
    if (weightSum == 0.0) return;
    result[p].colour = sum / weightSum;
    for (const auto& [weight, colour] : taps)
      result[p].spread += weight / weightSum * glm::abs(colour - result[p].colour);
  });
  return result;
}

}  // namespace walr::reference
