#include "tests/passes/reference/guides.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/passes/reference/octahedral.h"

namespace walr::reference {
namespace {

/// Relative error of an inverse. Vulkan ("Precision of core operations") allows a division 2.5 units in the last place,
/// and a unit in the last place is at most two roundoffs.
constexpr double kInverseError = 5.0 * kFloatRoundoff;
/// Relative error of a position: two roundings in the ray, the inverse depth and one division.
constexpr double kPositionError = 2.0 * kFloatRoundoff + 2.0 * kInverseError;
/// Error of a shading normal: a rotation to view space, a sum of three squares and an inverse square root.
constexpr double kShadingNormalError = 16.0 * kFloatRoundoff;

/// Inverse view depth; 0 outside the image and on sky.
double inverseDepthAt(const HostFrame& frame, glm::ivec2 p) {
  if (!frame.depth.contains(p)) return 0.0;
  const double z = frame.depth[p];
  return std::isfinite(z) && z > 0.0 && z < double(frame.constants.skyDepth) ? 1.0 / z : 0.0;
}

/// A vector in the surface along an axis of the image.
struct Tangent {
  glm::dvec3 value;
  double error;              ///< Absolute error of `value` in single precision.
  double misfit = 0.0;       ///< How far the extrapolation from two pixels misses the centre's inverse depth.
  double misfitError = 0.0;  ///< Bound of what single precision adds to `misfit`.
};

/// Drop the second of two tangents where rounding cannot make it the better one.
void keepUndecided(std::vector<Tangent>& candidates) {
  if (candidates.size() < 2) return;
  const double gap = candidates[1].misfit - candidates[0].misfit;
  if (gap > candidates[0].misfitError + candidates[1].misfitError) candidates.pop_back();
}

/// The direction along an axis of the image in the plane of the shading normal.
Tangent shadingTangent(const HostFrame& frame, glm::ivec2 p, glm::ivec2 axis, glm::dvec3 shadingNormal) {
  const glm::dvec3 ray = rayThrough(frame.constants.rayFromPixel, pixelCentre(p));
  const glm::dvec3 step = rayThrough(frame.constants.rayFromPixel, pixelCentre(p + axis)) - ray;
  const glm::dvec3 value = ray * glm::dot(shadingNormal, step) - step * glm::dot(shadingNormal, ray);
  return {value, 2.0 * kShadingNormalError * glm::length(ray) * glm::length(step)};
}

/// The difference of positions along an axis, on the side with the smallest misfit. Where both sides exceed the
/// tolerance, the direction in the plane of the shading normal. The first entry is the exact answer; the others are
/// those that rounding may choose instead.
std::vector<Tangent> tangents(const HostFrame& frame, glm::ivec2 p, glm::ivec2 axis, glm::dvec3 shadingNormal,
                              double tolerance) {
  const double centreInverse = inverseDepthAt(frame, p);
  const glm::dvec3 centre = rayThrough(frame.constants.rayFromPixel, pixelCentre(p)) / centreInverse;
  const double largestMisfit = tolerance * centreInverse;
  std::vector<Tangent> found;
  for (const int side : {-1, 1}) {
    const glm::ivec2 q = p + side * axis;
    const double near = inverseDepthAt(frame, q);
    if (near == 0.0) continue;
    const double far = inverseDepthAt(frame, q + side * axis);
    const glm::dvec3 position = rayThrough(frame.constants.rayFromPixel, pixelCentre(q)) / near;
    Tangent t{};
    t.value = double(side) * (position - centre);
    t.misfit = std::abs(2.0 * near - far - centreInverse);
    t.misfitError = (kInverseError + 3.0 * kFloatRoundoff) * (2.0 * near + far + centreInverse);
    t.error = kPositionError * (glm::length(position) + glm::length(centre));
    if (t.misfit <= largestMisfit + t.misfitError) found.push_back(t);
  }
  std::stable_sort(found.begin(), found.end(), [](const Tangent& a, const Tangent& b) { return a.misfit < b.misfit; });
  keepUndecided(found);
  const Tangent fallback = shadingTangent(frame, p, axis, shadingNormal);
  if (found.empty() || found.front().misfit > largestMisfit) {
    found.insert(found.begin(), fallback);
  } else if (found.front().misfit > largestMisfit - found.front().misfitError) {
    found.push_back(fallback);
  }
  return found;
}

/// The cross product of two tangents, not normalised.
struct SpannedNormal {
  glm::dvec3 value{0.0};
  double error = 0.0;  ///< Absolute error in single precision.
};

SpannedNormal spannedNormal(const Tangent& x, const Tangent& y) {
  const double lengthX = glm::length(x.value);
  const double lengthY = glm::length(y.value);
  return {glm::cross(y.value, x.value),
          x.error * lengthY + y.error * lengthX + 16.0 * kFloatRoundoff * lengthX * lengthY};
}

}  // namespace

Surface surfaceAt(const HostFrame& frame, glm::ivec2 p, const PrepareGuidesSettings& settings) {
  const glm::dvec3 hostNormal = frame.normal[p];
  const glm::dvec3 albedo = frame.albedo[p];
  const bool hasNormal = isFinite(hostNormal) && glm::length(hostNormal) > 0.0;
  const auto least = double(settings.albedoThreshold);
  const bool hasLobe = least == 0.0 || (isFinite(albedo) && std::max({albedo.x, albedo.y, albedo.z}) >= least);
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
  const auto tolerance = double(settings.tangentTolerance);
  const std::vector<Tangent> alongX = tangents(frame, p, {1, 0}, surface.shadingNormal, tolerance);
  const std::vector<Tangent> alongY = tangents(frame, p, {0, 1}, surface.shadingNormal, tolerance);
  const NormalCandidate shading{surface.shadingNormal, kShadingNormalError};
  std::vector<NormalCandidate> candidates;
  for (const Tangent& x : alongX) {
    for (const Tangent& y : alongY) {
      const auto [n, absoluteError] = spannedNormal(x, y);
      const double area = glm::length(n);
      if (!(area > 0.0)) {
        candidates.push_back(shading);
        continue;
      }
      const double error = absoluteError / area;
      const double agreement = glm::dot(n / area, surface.shadingNormal) - double(settings.normalAgreement);
      const bool shadingWins = agreement < 0.0;
      const NormalCandidate geometric{n / area, error};
      candidates.push_back(shadingWins ? shading : geometric);
      if (std::abs(agreement) <= error + 16.0 * kFloatRoundoff) candidates.push_back(shadingWins ? geometric : shading);
    }
  }
  return candidates;
}

double ambientOcclusion(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                        const AmbientOcclusionSettings& settings) {
  const auto rayAt = [&](glm::ivec2 q) { return rayThrough(frame.constants.rayFromPixel, pixelCentre(q)); };
  const double radius = std::max(double(settings.radius) * frame.size().y, 1.0);
  const double reach = radius * std::abs(double(frame.constants.rayFromPixel.x));
  double sum = 0.0;
  for (int i = 0; i < 9; ++i) {
    const glm::ivec2 direction = glm::ivec2(i % 3, i / 3) - 1;
    if (direction == glm::ivec2(0)) continue;
    double horizon = 0.0;
    const bool diagonal = direction.x != 0 && direction.y != 0;
    for (std::uint32_t ring = diagonal ? 1 : 0; ring < settings.rings; ring += 2) {
      const double power = settings.rings > 1 ? ring / (settings.rings - 1.0) : 0.0;
      const double growing = std::round(std::pow(std::max(radius * 2.0 / 3.0, 1.0), power));
      const int distance = std::max(static_cast<int>(growing), static_cast<int>(ring / 2) + 1);
      const glm::ivec2 q = p + distance * direction;
      const double inverseDepth = inverseDepthAt(frame, q);
      if (inverseDepth == 0.0) continue;
      const glm::dvec3 v = rayAt(q) / inverseDepth - rayAt(p) * surface.depth;
      const double length = glm::length(v);
      const double searched = reach / inverseDepth;
      const double fade = std::max(1.0 - length * length / (searched * searched), 0.0);
      horizon = std::max(horizon, fade * glm::dot(surface.shadingNormal, v) / length);
    }
    sum += horizon;
  }
  return sum / 8.0;
}

Image<Guide> prepareGuides(const HostFrame& frame, Storage storage, const PrepareGuidesSettings& settings,
                           const std::optional<AmbientOcclusionSettings>& occlusion) {
  Image<Guide> guides(frame.size());
  forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const Surface surface = surfaceAt(frame, p, settings);
    if (surface.depth == 0.0) return;
    Guide guide{surface.depth, octahedralEncode(surface.shadingNormal),
                geometricNormals(frame, p, surface, settings).front().normal};
    if (frame.objectId.contains(p)) guide.object = frame.objectId[p] + 1U;
    if (occlusion) guide.occlusion = ambientOcclusion(frame, p, surface, *occlusion);
    if (storage == Storage::Quantised) {
      const glm::dvec2 features = guide.features;
      guide.depth = occlusion ? roundDepthBesideNormal(guide.depth) : roundDepth(guide.depth);
      guide.features = occlusion
                           ? glm::dvec2(roundToUnorm(features.x, kUnorm12Step), roundToUnorm(features.y, kUnorm12Step))
                           : roundToUnorms(features);
      guide.occlusion = roundToUnorm(guide.occlusion, kUnorm8Step);
      guide.normal = occlusion ? roundToShortNormal(guide.normal) : roundToNormal(guide.normal);
    }
    guides[p] = guide;
  });
  return guides;
}

}  // namespace walr::reference
