#include "tests/passes/reference/guides.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// A division may err by 2.5 units in the last place (Vulkan, "Precision of core operations"), a sum or product by half
/// of one; a unit in the last place is at most two roundoffs.
constexpr double kInverseError = 5.0 * kFloatRoundoff;
/// Relative error of a position: two roundings in the ray, the inverse depth, one division.
constexpr double kPositionError = 2.0 * kFloatRoundoff + 2.0 * kInverseError;

bool isFinite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Inverse view depth; 0 outside the picture and on sky.
double inverseDepthAt(const HostFrame& frame, glm::ivec2 p) {
  if (!frame.depth.contains(p)) return 0.0;
  const double z = frame.depth[p];
  return std::isfinite(z) && z > 0.0 && z < double(frame.constants.skyDepth) ? 1.0 / z : 0.0;
}

struct Tangent {
  glm::dvec3 value;
  double misfit;       ///< How far the two pixels on this side miss the centre's inverse depth.
  double misfitError;  ///< What single precision may add to that.
  double error;        ///< Absolute error of `value` in single precision.
};

/// Both one-sided differences of position along an axis that exist, best first.
std::vector<Tangent> tangents(const HostFrame& frame, glm::ivec2 p, glm::ivec2 axis) {
  const double centreInverse = inverseDepthAt(frame, p);
  const glm::dvec3 centre = rayThrough(frame.constants.rayFromPixel, pixelCentre(p)) / centreInverse;
  std::vector<Tangent> found;
  for (const int side : {-1, 1}) {
    const glm::ivec2 q = p + side * axis;
    const double near = inverseDepthAt(frame, q);
    if (near == 0.0) continue;
    const double far = inverseDepthAt(frame, q + side * axis);
    const glm::dvec3 position = rayThrough(frame.constants.rayFromPixel, pixelCentre(q)) / near;
    Tangent t{};
    t.value = double(side) * (position - centre);
    t.misfit = far > 0.0 ? std::abs(2.0 * near - far - centreInverse) : std::abs(near - centreInverse);
    t.misfitError = (kInverseError + 2.0 * kFloatRoundoff) * (2.0 * near + far + centreInverse);
    t.error = kPositionError * (glm::length(position) + glm::length(centre));
    found.push_back(t);
  }
  std::stable_sort(found.begin(), found.end(), [](const Tangent& a, const Tangent& b) { return a.misfit < b.misfit; });
  return found;
}

/// Drop the second of two tangents where the first is better beyond doubt.
void keepUndecided(std::vector<Tangent>& candidates) {
  if (candidates.size() < 2) return;
  const double gap = candidates[1].misfit - candidates[0].misfit;
  if (gap > candidates[0].misfitError + candidates[1].misfitError) candidates.pop_back();
}

}  // namespace

Surface surfaceAt(const HostFrame& frame, glm::ivec2 p, const PrepareGuidesSettings& settings) {
  const glm::dvec3 hostNormal = frame.normal[p];
  const glm::dvec3 albedo = frame.albedo[p];
  const bool hasNormal = isFinite(hostNormal) && glm::length(hostNormal) > 0.0;
  const bool hasLobe = isFinite(albedo) && std::max({albedo.x, albedo.y, albedo.z}) >= double(settings.albedoThreshold);
  if (inverseDepthAt(frame, p) == 0.0 || !hasNormal || !hasLobe) return {};

  glm::dvec3 normal = glm::normalize(hostNormal);
  if (frame.conventions.normal == InputConventions::Space::World) {
    normal = glm::normalize(glm::dmat3(frame.constants.viewFromWorld) * normal);
  }
  const glm::dvec3 ray = rayThrough(frame.constants.rayFromPixel, pixelCentre(p));
  return {frame.depth[p], glm::dot(normal, ray) > 0.0 ? -normal : normal};
}

std::vector<NormalCandidate> geometricNormals(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                                              const PrepareGuidesSettings& settings) {
  std::vector<Tangent> alongX = tangents(frame, p, {1, 0});
  std::vector<Tangent> alongY = tangents(frame, p, {0, 1});
  keepUndecided(alongX);
  keepUndecided(alongY);
  const NormalCandidate shading{surface.shadingNormal, 8.0 * kFloatRoundoff};
  std::vector<NormalCandidate> candidates;
  for (const Tangent& x : alongX) {
    for (const Tangent& y : alongY) {
      const glm::dvec3 n = glm::cross(y.value, x.value);
      const double area = glm::length(n);
      if (!(area > 0.0)) continue;
      const double sides = glm::length(x.value) + glm::length(y.value);
      const double error = (std::max(x.error, y.error) * sides + 8.0 * kFloatRoundoff * sides * sides) / area;
      const double agreement = glm::dot(n / area, surface.shadingNormal) - double(settings.normalAgreement);
      const bool shadingWins = agreement < 0.0;
      const NormalCandidate geometric{n / area, error};
      candidates.push_back(shadingWins ? shading : geometric);
      if (std::abs(agreement) <= error + 16.0 * kFloatRoundoff) candidates.push_back(shadingWins ? geometric : shading);
    }
  }
  if (candidates.empty()) candidates.push_back(shading);
  return candidates;
}

Image<Guide> prepareGuides(const HostFrame& frame, Storage storage, const PrepareGuidesSettings& settings) {
  Image<Guide> guides(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const Surface surface = surfaceAt(frame, p, settings);
    if (surface.depth == 0.0) return;
    Guide guide{surface.depth, octahedralEncode(surface.shadingNormal),
                geometricNormals(frame, p, surface, settings).front().normal};
    if (storage == Storage::Quantised) {
      const glm::dvec2 packed = octahedralEncode(guide.normal);
      guide.depth = roundDepth(guide.depth);
      guide.features = {roundToUnorm16(guide.features.x), roundToUnorm16(guide.features.y)};
      guide.normal = octahedralDecode({roundToUnorm16(packed.x), roundToUnorm16(packed.y)});
    }
    guides[p] = guide;
  });
  return guides;
}

}  // namespace walr::reference
